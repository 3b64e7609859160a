#pragma once

#include <array>

#include "trajectory/exporter.h"

namespace careen {

extern const Exporter kGlbExporter;
extern const Exporter kMjcfExporter;
extern const Exporter kNpzExporter;
extern const Exporter kCsvExporter;

/// All kinds of files that a run is written as.
inline constexpr std::array kExporters = {&kGlbExporter, &kMjcfExporter, &kNpzExporter, &kCsvExporter};

}  // namespace careen
