#include "exchange/export_mjcf.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/brief.h"
#include "core/error.h"
#include "exchange/export_mjcf_joints.h"
#include "exchange/exporters.h"
#include "exchange/mjcf_text.h"
#include "exchange/mjcf_tree.h"

namespace careen {
namespace {

// From one body's box, or the world, to another's.
struct Placed {
  Vec3 position;
  Quat turn;
};
Placed seenFrom(const Body* parent, const Pose& box) {
  if (parent == nullptr) {
    return {box.position, Quat(box.worldFromBody).normalized()};
  }
  const Pose outer = boxPose(*parent, parent->initial.pose);
  const Mat3 back = outer.worldFromBody.transpose();
  return {back * Vec3(box.position - outer.position), Quat(Mat3(back * box.worldFromBody)).normalized()};
}

// The shortest turn of z to this direction.
Quat turnOfPlane(const Vec3& normal) {
  return normal.z() < -1 + 1e-12 ? Quat(0, 1, 0, 0)
                                 : Quat(1 + normal.z(), -normal.y(), normal.x(), 0).normalized();
}

class MjcfWriter {
 public:
  MjcfWriter(const RunSetup& setup, const std::string& program)
      : setup_(setup), world_(setup.world), tree_(treeOf(world_)), joints_(encodeJoints(world_, tree_)) {
    findMaterials();
    findGeoms();
    findSites();
    file_.text = "<!-- By " + program + ". ";
  }

  MjcfFile file() {
    file_.leftOut = joints_.leftOut;
    const std::string whyNoDrag = world_.drag ? whyDragIsLeftOut() : "";
    if (!whyNoDrag.empty()) {
      file_.leftOut.push_back("drag: " + whyNoDrag);
    }
    if (!world_.gravityChanges.empty()) {
      file_.leftOut.emplace_back("how gravity changes");
    }
    if (hasBelts(world_)) {
      file_.leftOut.emplace_back("how surfaces move along themselves");
    }
    if (hasCourses(world_)) {
      file_.leftOut.emplace_back("how " + whatHasCourses(world_) + " move");
    }
    leaveOutRestitution();
    for (const std::string& words : file_.leftOut) {
      std::string safe = words;  // no comment may hold two hyphens
      std::replace(safe.begin(), safe.end(), '-', '_');
      file_.text += "Left out: " + safe + ". ";
    }
    line("-->");
    line("<mujoco" + mjcfAttribute("model", setup_.stage.name) + ">");
    line("  <compiler angle=\"radian\"/>");
    line("  <option" + mjcfAttribute("gravity", mjcfNumbers(world_.gravity)) +
         R"( timestep="0.001" integrator="RK4" cone="elliptic"/>)");
    line("  <worldbody>");
    for (const Wall& wall : world_.walls) {
      line("    <geom" + mjcfAttribute("name", wall.name) + R"( type="plane" size="0 0 1")" +
           mjcfAttribute("pos", mjcfNumbers(Vec3(wall.offset * wall.normal))) +
           mjcfAttribute("quat", mjcfNumbers(turnOfPlane(wall.normal))) + frictionOf(wall.material) + "/>");
    }
    addBodies(world_.drag && whyNoDrag.empty() ? world_.drag->linear : 0);
    addSites(std::nullopt, "    ");
    line("  </worldbody>");
    addContacts();
    addSprings();
    addSection("tendon", tendons_);
    addSection("equality", joints_.equalities);
    addSection("actuator", joints_.actuators);
    addStart();
    line("</mujoco>");
    return std::move(file_);
  }

 private:
  void line(const std::string& text) { file_.text += text + "\n"; }

  void findMaterials() {
    std::set<double> frictions;
    for (const Body& body : world_.bodies) {
      frictions.insert(body.material.friction);
    }
    for (const Wall& wall : world_.walls) {
      frictions.insert(wall.material.friction);
    }
    isOneFriction_ = frictions.size() <= 1;
  }

  // Of several of a body the first has its name.
  void findGeoms() {
    std::set<std::string> taken;
    for (const Wall& wall : world_.walls) {
      taken.insert(wall.name);
    }
    for (const Body& body : world_.bodies) {
      taken.insert(body.name);
    }
    for (const Body& body : world_.bodies) {
      std::vector<std::string>& names = geoms_.emplace_back();
      names.push_back(body.name);
      for (int part = 1; part < body.partCount(); ++part) {
        std::string name = body.name + "-" + std::to_string(part + 1);
        while (!taken.insert(name).second) {
          name += "-";
        }
        names.push_back(std::move(name));
      }
      geomCount_ += names.size();
    }
  }

  // MuJoCo's acts on free bodies, at the middles of boxes as they are written.
  std::string whyDragIsLeftOut() const {
    const bool isOff = std::any_of(world_.bodies.begin(), world_.bodies.end(),
                                   [](const Body& body) { return !body.boxCenter.isZero(0); });
    return !world_.joints.empty()                        ? "MuJoCo has none of jointed boxes"
           : world_.drag->linear != world_.drag->angular ? "linear and angular differ"
           : isOff                                       ? "a centre of mass is not its box's middle"
                                                         : "";
  }

  void leaveOutRestitution() {
    double most = 0;
    for (const Body& body : world_.bodies) {
      most = std::max(most, body.material.restitution);
    }
    for (const Wall& wall : world_.walls) {
      most = std::max(most, wall.material.restitution);
    }
    for (const Joint& joint : world_.joints) {
      most = std::max(most, joint.restitution);
    }
    if (most > 0) {
      file_.leftOut.push_back("restitution, up to " + brief(most));
    }
  }

  // Of MuJoCo's five coefficients the first two are sliding's; without any, a contact has one dimension.
  std::string frictionOf(const Material& material) const {
    return material.friction > 0
               ? " condim=\"3\"" + mjcfAttribute("friction", mjcfNumbers({material.friction, 0, 0}))
               : " condim=\"1\"";
  }

  // Each in the one that holds it.
  void addBodies(double damping) {
    std::vector<int> open;
    const auto close = [&] {
      open.pop_back();
      line(std::string(4 + 2 * open.size(), ' ') + "</body>");
    };
    for (const int body : tree_.order) {
      const std::optional<int> parent = tree_.parent[static_cast<std::size_t>(body)];
      while (!open.empty() && open.back() != parent) {
        close();
      }
      addBody(body, std::string(4 + 2 * open.size(), ' '), damping);
      open.push_back(body);
    }
    while (!open.empty()) {
      close();
    }
  }

  // Without its end.
  void addBody(int number, const std::string& indent, double damping) {
    const auto index = static_cast<std::size_t>(number);
    const Body& body = world_.bodies[index];
    const Color& color = setup_.stage.colors[index];
    const std::optional<int> parent = tree_.parent[index];
    const Placed placed = seenFrom(parent ? &world_.bodies[static_cast<std::size_t>(*parent)] : nullptr,
                                   boxPose(body, body.initial.pose));
    line(indent + "<body" + mjcfAttribute("name", body.name) +
         mjcfAttribute("pos", mjcfNumbers(placed.position)) +
         mjcfAttribute("quat", mjcfNumbers(placed.turn)) + ">");
    if (tree_.isFree(world_, number)) {
      line(indent + "  <joint type=\"free\"" +
           (damping > 0 ? mjcfAttribute("damping", inFull(damping)) : std::string()) + "/>");
    } else if (!joints_.ofBody[index].empty()) {
      line(indent + "  " + joints_.ofBody[index]);
    }
    if (!isImmovable(body.mass)) {
      const Quat principal = Quat(body.mass.bodyFromPrincipal).normalized();
      line(indent + "  <inertial" + mjcfAttribute("pos", mjcfNumbers(inBoxFrame(body, Vec3::Zero()))) +
           (body.mass.turned ? mjcfAttribute("quat", mjcfNumbers(principal)) : std::string()) +
           mjcfAttribute("mass", inFull(body.mass.mass)) +
           mjcfAttribute("diaginertia", mjcfNumbers(body.mass.inertiaBody)) + "/>");
    }
    for (int part = 0; part < body.partCount(); ++part) {
      addGeom(body, part, geoms_[index][static_cast<std::size_t>(part)], color, indent + "  ");
    }
    addSites(number, indent + "  ");
  }

  void addGeom(const Body& body, int part, const std::string& name, const Color& color,
               const std::string& indent) {
    std::string place;
    if (!body.parts.empty()) {
      const Pose inBox = partPose(body, part, Pose{});
      place = mjcfAttribute("pos", mjcfNumbers(inBox.position)) +
              mjcfAttribute("quat", mjcfNumbers(Quat(inBox.worldFromBody).normalized()));
    }
    line(indent + "<geom" + mjcfAttribute("name", name) + " type=\"box\"" + place +
         mjcfAttribute("size", mjcfNumbers(partHalfExtents(body, part))) + frictionOf(body.material) +
         mjcfAttribute("rgba", mjcfNumbers({color.red / 255.0, color.green / 255.0, color.blue / 255.0, 1})) +
         "/>");
  }

  /// An end of a spring, rope or rod.
  struct Site {
    std::string name;
    std::optional<int> body;
    Vec3 point;
  };
  void findSites() {
    for (std::size_t i = 0; i < world_.springs.size(); ++i) {
      const Spring& spring = world_.springs[i];
      sites_.push_back({mjcfSite("spring", i, "from"), spring.from.body, spring.from.point});
      sites_.push_back({mjcfSite("spring", i, "to"), spring.to.body, spring.to.point});
    }
    for (std::size_t i = 0; i < world_.joints.size(); ++i) {
      const Joint& joint = world_.joints[i];
      if (joint.kind == Joint::Kind::kRod || joint.kind == Joint::Kind::kRope) {
        sites_.push_back({mjcfSite("joint", i, "from"), joint.from.body, joint.from.point});
        sites_.push_back({mjcfSite("joint", i, "to"), joint.to.body, joint.to.point});
      }
    }
  }

  // Those on this body, or on none.
  void addSites(std::optional<int> body, const std::string& indent) {
    for (const Site& site : sites_) {
      if (site.body == body) {
        line(indent + "<site" + mjcfAttribute("name", site.name) +
             mjcfAttribute(
                 "pos",
                 mjcfNumbers(body ? inBoxFrame(world_.bodies[static_cast<std::size_t>(*body)], site.point)
                                  : site.point)) +
             "/>");
      }
    }
  }

  void addSection(const std::string& name, const std::vector<std::string>& elements) {
    if (elements.empty()) {
      return;
    }
    line("  <" + name + ">");
    for (const std::string& element : elements) {
      line("    " + element);
    }
    line("  </" + name + ">");
  }

  // A <pair> collides even if it is in the tree. Of two frictions MuJoCo takes the larger one; those that are
  // the same need no pairs, but for those bodies.
  void addContacts() {
    std::vector<std::string> elements = joints_.excludes;
    const std::size_t boxes = world_.bodies.size();
    if (!isOneFriction_ &&
        geomCount_ * (geomCount_ - 1) / 2 + geomCount_ * world_.walls.size() > kMostMjcfPairs) {
      throw InputError("found boxes and walls of different friction in more than " +
                       std::to_string(kMostMjcfPairs) + " pairs, expected fewer, or one friction for all");
    }
    for (std::size_t a = 0; a < boxes && !(isOneFriction_ && world_.joints.empty()); ++a) {
      const Body& body = world_.bodies[a];
      for (const Wall& wall : world_.walls) {
        if (!isOneFriction_ && tree_.oneWith[a]) {
          addPairs(geoms_[a], {wall.name}, touching(body.material, wall.material), elements);
        }
      }
      for (std::size_t b = a + 1; b < boxes; ++b) {
        const Body& other = world_.bodies[b];
        const int one = static_cast<int>(a);
        const int two = static_cast<int>(b);
        const bool isNeeded = !isOneFriction_ || tree_.areJoined(one, two);
        if (isNeeded && tree_.oneWith[a] != tree_.oneWith[b] && mayTouch(world_, one, two)) {
          addPairs(geoms_[a], geoms_[b], touching(body.material, other.material), elements);
        }
      }
    }
    addSection("contact", elements);
  }
  static void addPairs(const std::vector<std::string>& some, const std::vector<std::string>& others,
                       const Material& material, std::vector<std::string>& elements) {
    for (const std::string& one : some) {
      for (const std::string& other : others) {
        elements.push_back(pairOf(one, other, material));
      }
    }
  }
  static std::string pairOf(const std::string& a, const std::string& b, const Material& material) {
    const double friction = material.friction;
    return "<pair" + mjcfAttribute("geom1", a) + mjcfAttribute("geom2", b) +
           (friction > 0
                ? " condim=\"3\"" + mjcfAttribute("friction", mjcfNumbers({friction, friction, 0, 0, 0}))
                : std::string(" condim=\"1\"")) +
           "/>";
  }

  void addSprings() {
    for (std::size_t i = 0; i < world_.springs.size(); ++i) {
      const Spring& spring = world_.springs[i];
      tendons_.push_back("<spatial" + mjcfAttribute("stiffness", inFull(spring.stiffness)) +
                         mjcfAttribute("damping", inFull(spring.damping)) +
                         mjcfAttribute("springlength", inFull(spring.restLength)) + "><site" +
                         mjcfAttribute("site", mjcfSite("spring", i, "from")) + "/><site" +
                         mjcfAttribute("site", mjcfSite("spring", i, "to")) + "/></spatial>");
    }
    tendons_.insert(tendons_.end(), joints_.tendons.begin(), joints_.tendons.end());
  }

  void addStart() {
    if (!joints_.places.empty()) {
      line("  <keyframe>");
      line("    <key name=\"start\"" + mjcfAttribute("qpos", joints_.places) +
           mjcfAttribute("qvel", joints_.speeds) + "/>");
      line("  </keyframe>");
    }
  }

  const RunSetup& setup_;
  const World& world_;
  MjcfTree tree_;
  MjcfJoints joints_;
  std::vector<std::vector<std::string>> geoms_;  // their names, by body
  std::size_t geomCount_ = 0;
  std::vector<Site> sites_;
  std::vector<std::string> tendons_;
  MjcfFile file_;
  bool isOneFriction_ = false;
};

}  // namespace

MjcfFile encodeMjcf(const RunSetup& setup, const std::string& program) {
  return MjcfWriter(setup, program).file();
}

constexpr Exporter kMjcfExporter = {
    .suffix = ".xml",
    .about = "its start, for MuJoCo",
    .write = [](const Trajectory& run, const ExportSettings& settings, const TextSink& sink) -> ExportNotes {
      const MjcfFile mjcf = encodeMjcf(run, settings.program);
      sink(mjcf.text);
      ExportNotes lines;
      for (const std::string& words : mjcf.leftOut) {
        lines.push_back("left out     " + words);
      }
      return lines;
    }};

}  // namespace careen
