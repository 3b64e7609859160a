#pragma once

#include "exchange/xml_tree.h"

namespace careen {

/// Puts what the root of another file has in the place of each <include file="…"/>, in any depth, as MuJoCo
/// does. A file is looked for beside the first one, then beside the one that names it. InputError if it is
/// not there, has no elements, or has been read already: so no file includes itself.
void includeFiles(XmlTree& tree);

}  // namespace careen
