#pragma once

#include <array>
#include <string>

#include "core/brief.h"
#include "support/random_text.h"

namespace careen {

/// Writes models that use every notation of orientations, nested classes, masses of all kinds, geoms that
/// only show, boxes between two points, what <compiler> changes of masses, and a key frame.
class RandomMjcf : RandomText {
 public:
  /// MuJoCo 2.2.2 knows no <frame> and no <replicate>. Models with them are written a second time, alike but
  /// for fixed bodies in the place of frames, of copies and of free bodies, whose poses are the same.
  enum class Frames { kNone, kWritten, kAsBodies };

  explicit RandomMjcf(unsigned seed, Frames frames = Frames::kNone) : RandomText(seed), frames_(frames) {}

  std::string text() {
    isRadian_ = chance(2);
    std::string all = "<mujoco model=\"random\">\n<compiler" +
                      std::string(isRadian_   ? " angle=\"radian\""
                                  : chance(2) ? " angle=\"degree\""
                                              : "") +
                      (chance(2) ? " eulerseq=\"" + sequence() + "\"" : "") + massRules() +
                      "/>\n<option gravity=\"" + vector(10) + "\">" + "<flag" +
                      (chance(5) ? " gravity=\"disable\"" : "") +
                      (frames_ == Frames::kAsBodies ? " contact=\"disable\"" : "") + "/></option>\n";
    all += "<default>\n<geom density=\"" + positive() + "\" friction=\"0.5\"/>\n<joint damping=\"0\"/>\n" +
           "<default class=\"one\"><geom type=\"box\" size=\"" + positives(3) + "\" " + orientation() +
           "/>\n" + "<default class=\"two\"><geom size=\"" + positives(1) + "\"" +
           (chance(2) ? " mass=\"" + positive() + "\"" : "") + "/>" + "<joint type=\"free\"/></default>" +
           "</default></default>\n<worldbody>\n";
    const std::size_t count = 1 + random_() % 5;
    for (std::size_t i = 0; i < count; ++i) {
      all += withoutMarks(framed(3));
    }
    all += withoutMarks(movable()) + "</worldbody>\n";
    if (frames_ == Frames::kNone && chance(2)) {
      all += "<keyframe><key name=\"start\" qpos=\"";
      for (int i = 0; i < movables_; ++i) {
        all += (i == 0 ? "" : " ") + vector(3) + " " + numbers(4, 2);
      }
      all += "\" qvel=\"";
      for (int i = 0; i < movables_; ++i) {
        all += (i == 0 ? "" : " ") + numbers(6, 5);
      }
      all += "\"/></keyframe>\n";
    }
    return all + "</mujoco>\n";
  }

 private:
  using Point = std::array<double, 3>;

  std::string positive() { return inFull(real(0.1, 3)); }
  std::string positives(int count) {
    std::string text = positive();
    for (int i = 1; i < count; ++i) {
      text += " " + positive();
    }
    return text;
  }
  Point point(double most) {
    const double x = real(-most, most);
    const double y = real(-most, most);
    return {x, y, real(-most, most)};
  }
  // As near as keeps a centre of mass in the smallest box.
  Point near(const Point& at) {
    const Point off = point(0.05);
    return {at[0] + off[0], at[1] + off[1], at[2] + off[2]};
  }
  static std::string textOf(const Point& at) {
    return inFull(at[0]) + " " + inFull(at[1]) + " " + inFull(at[2]);
  }
  std::string sequence() {
    std::string axes;
    for (int i = 0; i < 3; ++i) {
      axes += "xyzXYZ"[random_() % 6];
    }
    return axes;
  }
  std::string angle() { return inFull(isRadian_ ? real(-4, 4) : real(-400, 400)); }

  // Bodies in the place of frames would have masses of their own.
  std::string massRules() {
    std::string rules = chance(3) ? " inertiagrouprange=\"0 2\"" : "";
    if (frames_ == Frames::kNone) {
      rules += (chance(4) ? " boundmass=\"" + positive() + "\"" : "") +
               (chance(4) ? " boundinertia=\"" + positive() + "\"" : "") +
               (chance(4) ? " balanceinertia=\"true\"" : "") +
               (chance(4) ? " settotalmass=\"" + positive() + "\"" : "");
    }
    return rules;
  }

  // The classes "one" and "two" have an orientation already, and MuJoCo takes no two.
  std::string orientation() {
    switch (random_() % 6) {
      case 0:
        return "quat=\"" + numbers(4, 2) + "\"";
      case 1:
        return "axisangle=\"" + vector(2) + " " + angle() + "\"";
      case 2:
        return "euler=\"" + angle() + " " + angle() + " " + angle() + "\"";
      case 3:
        return "xyaxes=\"" + vector(2) + " " + vector(2) + "\"";
      case 4:
        return "zaxis=\"" + (chance(5) ? "0 0 -2" : vector(2)) + "\"";
      default:
        return "";
    }
  }
  std::string placed(double most) { return " pos=\"" + vector(most) + "\" " + orientation(); }

  // ---- Frames and copies

  // What names of copies end in stands where the mark is, after a letter, since numbers may be it.
  std::string name(const char* kind) { return kind + std::to_string(++names_) + "n@"; }
  static std::string marked(const std::string& text, const std::string& end) {
    std::string all;
    for (const char letter : text) {
      all += letter == '@' ? end : std::string(1, letter);
    }
    return all;
  }
  static std::string withoutMarks(const std::string& text) { return marked(text, ""); }

  std::string framed(int depth) {
    if (frames_ == Frames::kNone || depth == 0 || chance(3)) {
      return chance(3) ? plane() : chance(3) ? statics(1) : movable();
    }
    return chance(3) ? copies(depth - 1) : frame(framed(depth - 1), 3);
  }
  std::string frame(const std::string& inside, double most) {
    const std::string kind = frames_ == Frames::kWritten ? "frame" : "body";
    return "<" + kind + placed(most) + ">" + inside + "</" + kind + ">\n";
  }
  // About one axis a chain of bodies turns and moves as copies do.
  std::string copies(int depth) {
    const int count = static_cast<int>(1 + random_() % 4);
    const std::string separator = chance(2) ? "-" : "";
    const std::size_t axis = random_() % 3;
    std::string euler = axis == 0 ? angle() + " 0 0" : axis == 1 ? "0 " + angle() + " 0" : "0 0 " + angle();
    const std::string step = "\"" + vector(2) + "\" euler=\"" + euler + "\"";
    const std::string inside = framed(depth);
    if (frames_ == Frames::kWritten) {
      return "<replicate count=\"" + std::to_string(count) + "\" sep=\"" + separator + "\" offset=" + step +
             ">" + inside + "</replicate>\n";
    }
    std::string text;
    std::string begin = "<body>";
    std::string end = "</body>";
    for (int i = 0; i < count; ++i) {
      text += begin + marked(inside, separator + std::to_string(i) + "@") + end;
      begin += "<body pos=" + step + ">";
      end += "</body>";
    }
    return text;
  }

  // ---- Bodies

  std::string plane() {
    return "<geom name=\"" + name("w") + "\" type=\"plane\" size=\"1 1 1\"" + placed(3) + "/>\n";
  }
  // Whose middle is there, from end to end.
  std::string fromTo(const Point& at) {
    Point half = point(1);
    half[2] = half[2] < 0 ? half[2] - 0.1 : half[2] + 0.1;
    return " fromto=\"" + textOf({at[0] - half[0], at[1] - half[1], at[2] - half[2]}) + " " +
           textOf({at[0] + half[0], at[1] + half[1], at[2] + half[2]}) + "\"";
  }
  std::string fixedBox() {
    const int kind = static_cast<int>(random_() % 4);
    const std::string own =
        kind < 2    ? " class=\"one\" pos=\"" + vector(2) + "\""
        : kind == 2 ? " type=\"box\" size=\"" + positives(3) + "\"" + placed(2)
                    : " type=\"box\" size=\"" + positives(2) + "\"" + fromTo(point(2)) + " " + orientation();
    return "<geom name=\"" + name("s") + "\"" + own + "/>\n";
  }
  std::string statics(int depth) {
    return "<body " + placed(2) + ">" + fixedBox() + (chance(2) ? fixedBox() : "") +
           (chance(3) ? visual(point(2)) : "") + (depth < 4 && chance(2) ? statics(depth + 1) : "") +
           "</body>\n";
  }

  // A geom that collides with nothing, of any shape. It counts if its group does.
  std::string visual(const Point& at) {
    static const std::array<const char*, 5> kTypes = {"box", "sphere", "capsule", "cylinder", "ellipsoid"};
    const std::size_t type = random_() % kTypes.size();
    std::string text = "<geom class=\"main\" contype=\"0\" conaffinity=\"0\" group=\"" +
                       std::to_string(random_() % 5) + "\" type=\"" + kTypes[type] + "\" size=\"" +
                       positives(3) + "\"";
    text += type != 1 && chance(3) ? fromTo(at) : " pos=\"" + textOf(at) + "\"";
    text += " " + orientation();
    switch (random_() % 4) {
      case 0:
        return text + " mass=\"" + positive() + "\"/>";
      case 1:
        return text + (chance(2) ? " mass=\"0\"/>" : " density=\"0\"/>");
      default:
        return text + "/>";
    }
  }
  // Beside a box whose middle is there.
  std::string visuals(const Point& at) { return chance(2) ? "" : visual(near(at)) + visual(near(at)); }

  std::string movable() {
    ++movables_;
    const std::string own = name("m");
    const int kind = static_cast<int>(random_() % 5);
    std::string text =
        "<body name=\"" + own + "\"" + (kind == 1 ? " childclass=\"two\"" : "") + placed(5) + ">";
    const std::string joint = kind == 1 ? "<joint/>" : chance(2) ? "<freejoint/>" : "<joint type=\"free\"/>";
    text += frames_ == Frames::kAsBodies ? "" : joint;
    const Point middle = point(1);
    const std::string place = " pos=\"" + textOf(middle) + "\" ";
    const std::string geom = "<geom name=\"" + own + "\"";
    const std::string box = " type=\"box\" size=\"" + positives(3) + "\"" + place;
    const std::string turn = orientation();
    const std::string shown = visuals(middle);
    std::string all;
    if (kind == 0) {
      all = geom + " class=\"one\"" + place + "/>" + shown;
    } else if (kind == 1) {
      all = geom + place + (chance(2) ? "density=\"" + positive() + "\"" : "") + "/>" + shown;
    } else if (kind == 2) {
      all = shown + geom + box + turn + (chance(2) ? " mass=\"" + positive() + "\"" : "") + "/>";
    } else if (kind == 3) {
      all = geom + " type=\"box\" size=\"" + positive() + "\"" + fromTo(middle) + "/>" + shown;
    } else {
      return text + withInertial(geom, box, place, turn, middle) + shown + "</body>\n";
    }
    return text + (frames_ != Frames::kNone && chance(2) ? frame(all, 1) : all) + "</body>\n";
  }

  std::string withInertial(const std::string& geom, const std::string& box, const std::string& place,
                           const std::string& turn, const Point& middle) {
    const double least = real(0.1, 1);
    const std::string mass = " mass=\"" + positive() + "\" diaginertia=\"" + inFull(least) + " " +
                             inFull(least * 1.3) + " " + inFull(least * 1.7) + "\"/>";
    if (chance(2)) {  // about a place of its own, along axes of its own
      return geom + box + turn + "/><inertial pos=\"" + textOf(near(middle)) + "\" " + orientation() + mass;
    }
    // The axes of <inertial> are those of the box.
    return geom + box + turn + "/><inertial" + place + turn + mass;
  }

  Frames frames_;
  bool isRadian_ = false;
  int names_ = 0;
  int movables_ = 0;
};

}  // namespace careen
