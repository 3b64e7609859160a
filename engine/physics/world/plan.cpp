#include "physics/world/plan.h"

#include <algorithm>
#include <stdexcept>

namespace careen {

bool Plan::models(std::string_view what) const {
  const auto item =
      std::find_if(items.begin(), items.end(), [what](const PlanItem& each) { return each.what == what; });
  if (item == items.end()) {
    throw std::logic_error("no plan has an item " + std::string(what));
  }
  return item->modelled;
}

std::vector<std::string> Plan::modelled() const {
  std::vector<std::string> names;
  for (const PlanItem& item : items) {
    if (item.modelled) {
      names.push_back(item.what);
    }
  }
  return names;
}

std::vector<std::string> Plan::leftOut() const {
  std::vector<std::string> names;
  for (const PlanItem& item : items) {
    if (!item.modelled) {
      names.push_back(item.what);
    }
  }
  return names;
}

}  // namespace careen
