// Attributes of a dataset, group or file: written once at creation, read only if of the expected type.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "hdf5/checked.hpp"

namespace peterka::hdf5 {

void write_attribute(const Checked& check, hid_t object, const char* name, const std::string& text);
void write_attribute(const Checked& check, hid_t object, const char* name, double number);
void write_attribute(const Checked& check, hid_t object, const char* name, std::int32_t number);
void write_attribute(const Checked& check, hid_t object, const char* name,
                     std::span<const std::int8_t> numbers);
void write_attribute(const Checked& check, hid_t object, const char* name,
                     std::span<const std::int32_t> numbers);

// Nothing if the object has no such attribute or it is of another type.
[[nodiscard]] std::optional<std::string> read_text(hid_t object, const char* name);
[[nodiscard]] std::optional<std::int32_t> read_integer(hid_t object, const char* name);

}  // namespace peterka::hdf5
