// Text that is put together piece by piece.
#pragma once

#include <string>

namespace lapilli {

// Appends what printf would print.
[[gnu::format(printf, 2, 3)]] void append_format(std::string& text, const char* format, ...);

}  // namespace lapilli
