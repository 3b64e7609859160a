#include "compare/page_files.h"

#include "core/system/resource.h"

namespace careen {

std::string pageFile(const std::string& name) {
  return codeText(codeFolder(), "assets/compare/" + name, embeddedPageFile(name));
}

}  // namespace careen
