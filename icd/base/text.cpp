// printf into a string.
#include "base/text.h"

#include <cstdarg>
#include <cstdio>

namespace lapilli {

void append_format(std::string& text, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  va_list again;
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  va_end(arguments);
  if (length > 0) {
    const size_t begin = text.size();
    text.resize(begin + static_cast<size_t>(length));
    std::vsnprintf(text.data() + begin, static_cast<size_t>(length) + 1, format, again);
  }
  va_end(again);
}

}  // namespace lapilli
