// The page of an event: HTML that needs nothing besides itself, neither files nor a network.
#pragma once

#include <string>

#include "apps/planned_output.h"

namespace floe {

// Title, style, program and data in one text. `data` as page_data() makes it.
std::string event_page(const std::string& title, const Json& data);

}  // namespace floe
