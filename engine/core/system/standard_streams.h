#pragma once

namespace careen {

/// Opens /dev/null in place of a standard stream that the caller of this program closed. Otherwise the next
/// file or socket would get its number, and what is printed would go into it. Call it before anything is
/// opened.
void openStandardStreams();

}  // namespace careen
