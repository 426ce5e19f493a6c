// Messages on stderr. They must never end a run: a full or missing log is no reason to lose the map.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

#include "support/escape_untrusted.hpp"

namespace peterka {

template <class... Values>
void tell(fmt::format_string<Values...> format, Values&&... values) {
    const std::string text = escape_untrusted_page(fmt::format(format, std::forward<Values>(values)...));
    static_cast<void>(std::fputs(text.c_str(), stderr));
}

}  // namespace peterka
