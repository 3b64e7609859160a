#include "study/plot_files.h"

#include "core/system/resource.h"

namespace careen {

std::string plotFile(const std::string& name) {
  return codeText(codeFolder(), "assets/plots/" + name, embeddedPlotFile(name));
}

}  // namespace careen
