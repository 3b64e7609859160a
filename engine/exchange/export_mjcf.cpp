#include "exchange/export_mjcf.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <set>

#include "core/brief.h"
#include "core/error.h"
#include "exchange/exporters.h"

namespace careen {
namespace {

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    text += (text.empty() ? "" : " ") + inFull(value);
  }
  return text;
}
std::string numbers(const Vec3& v) { return numbers({v.x(), v.y(), v.z()}); }
std::string numbers(const Quat& q) { return numbers({q.w(), q.x(), q.y(), q.z()}); }

std::string escaped(const std::string& text) {
  std::string result;
  for (const char letter : text) {
    switch (letter) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += letter;
    }
  }
  return result;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + escaped(value) + "\"";
}

// MJCF's body frame is the box's: its origin is the middle.
Vec3 inBoxFrame(const Body& body, const Vec3& point) {
  return body.boxCenter.isZero(0) ? point : Vec3(point - body.boxCenter);
}

// The shortest turn of z to this direction.
Quat turnOfPlane(const Vec3& normal) {
  return normal.z() < -1 + 1e-12 ? Quat(0, 1, 0, 0)
                                 : Quat(1 + normal.z(), -normal.y(), normal.x(), 0).normalized();
}

class MjcfWriter {
 public:
  MjcfWriter(const RunSetup& setup, const std::string& program) : setup_(setup), world_(setup.world) {
    findMaterials();
    file_.text = "<!-- By " + program + ". ";
  }

  MjcfFile file() {
    const bool sameDrag = world_.drag && world_.drag->linear == world_.drag->angular;
    if (!world_.joints.empty()) {
      file_.leftOut.emplace_back("joints");
    }
    if (!world_.apart.empty()) {
      file_.leftOut.emplace_back("which boxes pass through each other");
    }
    if (world_.drag && !sameDrag) {
      file_.leftOut.emplace_back("drag: linear and angular differ");
    }
    leaveOutRestitution();
    for (const std::string& words : file_.leftOut) {
      std::string safe = words;  // no comment may hold two hyphens
      std::replace(safe.begin(), safe.end(), '-', '_');
      file_.text += "Left out: " + safe + ". ";
    }
    line("-->");
    line("<mujoco" + attribute("model", setup_.stage.name) + ">");
    line("  <compiler angle=\"radian\"/>");
    line("  <option" + attribute("gravity", numbers(world_.gravity)) +
         R"( timestep="0.001" integrator="RK4" cone="elliptic"/>)");
    line("  <worldbody>");
    for (const Wall& wall : world_.walls) {
      line("    <geom" + attribute("name", wall.name) + R"( type="plane" size="0 0 1")" +
           attribute("pos", numbers(Vec3(wall.offset * wall.normal))) +
           attribute("quat", numbers(turnOfPlane(wall.normal))) + frictionOf(wall.material) + "/>");
    }
    for (std::size_t i = 0; i < world_.bodies.size(); ++i) {
      addBox(i, sameDrag ? world_.drag->linear : 0);
    }
    addSites(std::nullopt, "    ");
    line("  </worldbody>");
    addPairs();
    addSprings();
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

  void leaveOutRestitution() {
    double most = 0;
    for (const Body& body : world_.bodies) {
      most = std::max(most, body.material.restitution);
    }
    for (const Wall& wall : world_.walls) {
      most = std::max(most, wall.material.restitution);
    }
    if (most > 0) {
      file_.leftOut.push_back("restitution, up to " + brief(most));
    }
  }

  // Of MuJoCo's five coefficients the first two are sliding's; without any, a contact has one dimension.
  std::string frictionOf(const Material& material) const {
    return material.friction > 0 ? " condim=\"3\"" + attribute("friction", numbers({material.friction, 0, 0}))
                                 : " condim=\"1\"";
  }

  void addBox(std::size_t index, double damping) {
    const Body& body = world_.bodies[index];
    const bool isFixed = isImmovable(body.mass);
    const Color& color = setup_.stage.colors[index];
    const Quat turn = Quat(body.initial.pose.worldFromBody).normalized();
    const Vec3 middle = boxPose(body, body.initial.pose).position;
    line("    <body" + attribute("name", body.name) + attribute("pos", numbers(middle)) +
         attribute("quat", numbers(turn)) + ">");
    if (!isFixed) {
      line(std::string("      <joint type=\"free\"") +
           (damping > 0 ? attribute("damping", inFull(damping)) : std::string()) + "/>");
      const Quat principal = Quat(body.mass.bodyFromPrincipal).normalized();
      line("      <inertial" + attribute("pos", numbers(inBoxFrame(body, Vec3::Zero()))) +
           (body.mass.turned ? attribute("quat", numbers(principal)) : std::string()) +
           attribute("mass", inFull(body.mass.mass)) +
           attribute("diaginertia", numbers(body.mass.inertiaBody)) + "/>");
    }
    line("      <geom" + attribute("name", body.name) + " type=\"box\"" +
         attribute("size", numbers(body.halfExtents)) + frictionOf(body.material) +
         attribute("rgba", numbers({color.red / 255.0, color.green / 255.0, color.blue / 255.0, 1})) + "/>");
    addSites(static_cast<int>(index), "      ");
    line("    </body>");
  }

  // Ends of springs that are on this body, or on none.
  void addSites(std::optional<int> body, const std::string& indent) {
    for (std::size_t i = 0; i < world_.springs.size(); ++i) {
      const Spring& spring = world_.springs[i];
      for (const auto& [end, which] : {std::pair(&spring.from, "from"), std::pair(&spring.to, "to")}) {
        if (end->body == body) {
          line(indent + "<site" + attribute("name", siteName(i, which)) +
               attribute("pos",
                         numbers(body ? inBoxFrame(world_.bodies[static_cast<std::size_t>(*body)], end->point)
                                      : end->point)) +
               "/>");
        }
      }
    }
  }
  static std::string siteName(std::size_t spring, const char* which) {
    return "spring " + std::to_string(spring) + " " + which;
  }

  void addPairs() {
    if (isOneFriction_) {
      return;  // MuJoCo takes the larger of two, which are the same
    }
    const std::size_t boxes = world_.bodies.size();
    if (boxes * (boxes - 1) / 2 + boxes * world_.walls.size() > kMostMjcfPairs) {
      throw InputError("found boxes and walls of different friction in more than " +
                       std::to_string(kMostMjcfPairs) + " pairs, expected fewer, or one friction for all");
    }
    line("  <contact>");
    for (std::size_t a = 0; a < boxes; ++a) {
      const Body& body = world_.bodies[a];
      for (const Wall& wall : world_.walls) {
        if (!isImmovable(body.mass)) {
          addPair(body.name, wall.name, touching(body.material, wall.material));
        }
      }
      for (std::size_t b = a + 1; b < boxes; ++b) {
        const Body& other = world_.bodies[b];
        if (!(isImmovable(body.mass) && isImmovable(other.mass))) {
          addPair(body.name, other.name, touching(body.material, other.material));
        }
      }
    }
    line("  </contact>");
  }
  void addPair(const std::string& a, const std::string& b, const Material& material) {
    const double friction = material.friction;
    line("    <pair" + attribute("geom1", a) + attribute("geom2", b) +
         (friction > 0 ? " condim=\"3\"" + attribute("friction", numbers({friction, friction, 0, 0, 0}))
                       : std::string(" condim=\"1\"")) +
         "/>");
  }

  void addSprings() {
    if (world_.springs.empty()) {
      return;
    }
    line("  <tendon>");
    for (std::size_t i = 0; i < world_.springs.size(); ++i) {
      const Spring& spring = world_.springs[i];
      line("    <spatial" + attribute("stiffness", inFull(spring.stiffness)) +
           attribute("damping", inFull(spring.damping)) +
           attribute("springlength", inFull(spring.restLength)) + "><site" +
           attribute("site", siteName(i, "from")) + "/><site" + attribute("site", siteName(i, "to")) +
           "/></spatial>");
    }
    line("  </tendon>");
  }

  // Of a free joint: position and quaternion; velocity in the world's frame, angular velocity in the body's.
  void addStart() {
    std::string places;
    std::string speeds;
    const auto append = [](std::string& text, const std::string& more) {
      text += (text.empty() ? "" : " ") + more;
    };
    for (const Body& body : world_.bodies) {
      if (!isImmovable(body.mass)) {
        const Mat3& turn = body.initial.pose.worldFromBody;
        append(places, numbers(boxPose(body, body.initial.pose).position));
        append(places, numbers(Quat(turn).normalized()));
        append(speeds, numbers(boxVelocity(body, body.initial)));
        append(speeds, numbers(Vec3(turn.transpose() * angularVelocity(body.mass, body.initial))));
      }
    }
    if (!places.empty()) {
      line("  <keyframe>");
      line("    <key name=\"start\"" + attribute("qpos", places) + attribute("qvel", speeds) + "/>");
      line("  </keyframe>");
    }
  }

  const RunSetup& setup_;
  const World& world_;
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
