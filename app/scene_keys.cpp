#include "scene_keys.h"

#include <nlohmann/json.hpp>
#include <set>

#include "core/system/file.h"
#include "core/system/resource.h"

namespace careen {
namespace {

using Json = nlohmann::ordered_json;

class KeysOfSchema {
 public:
  explicit KeysOfSchema(const Json& schema) : schema_(schema) { add(schema, ""); }

  std::vector<SceneKey> take() { return std::move(keys_); }

 private:
  // What a part of the schema, or one that it refers to, says of keys below `path`.
  void add(const Json& part, const std::string& path) {
    if (const auto reference = part.find("$ref"); reference != part.end()) {
      add(referredTo(*reference), path);
    }
    const Json properties = part.value("properties", Json::object());
    for (const auto& [name, value] : properties.items()) {
      const std::string key = path.empty() ? name : path + "." + name;
      if (value.is_object() && name != "$schema" && known_.insert(key).second) {
        keys_.push_back({.path = key, .text = textOf(value)});
        add(value, key);
      }
    }
    if (const auto items = part.find("items"); items != part.end() && items->is_object()) {
      add(*items, path + "[]");
    }
    for (const char* const several : {"allOf", "anyOf", "oneOf"}) {
      for (const Json& each : part.value(several, Json::array())) {
        add(each, path);
      }
    }
  }

  const Json& referredTo(const Json& reference) const {
    return schema_.at(Json::json_pointer(reference.get<std::string>().substr(1)));
  }

  std::string textOf(const Json& value) const {
    if (const auto reference = value.find("$ref"); reference != value.end()) {
      return textOf(referredTo(*reference));
    }
    std::string text = value.value("description", value.value("title", ""));
    if (const auto usual = value.find("default"); usual != value.end()) {
      text += " Default: " + usual->dump() + ".";
    }
    return text;
  }

  const Json& schema_;
  std::vector<SceneKey> keys_;
  std::set<std::string> known_;
};

}  // namespace

std::vector<SceneKey> sceneKeys() {
  const Json schema = Json::parse(readFile(findResource("assets/scene.schema.json")));
  return KeysOfSchema(schema).take();
}

}  // namespace careen
