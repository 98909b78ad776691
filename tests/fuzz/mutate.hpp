#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "devlearn/random.hpp"

// Mutations that know what the input is made of. Only libFuzzer uses them.
namespace devlearn::fuzz {

/// libFuzzer's own mutation of a text, which may grow by up to 32 bytes.
void mutate_bytes(std::string& text);

/// Puts another number in the place of one in a text, if there is one: a near one, a special one,
/// or one of the text's others, for coincidences.
void mutate_number(std::string& text, Random& random);

/// The text in the fuzzer's buffer, cut to its size; the size.
std::size_t put(const std::string& text, std::uint8_t* data, std::size_t max_size);

}  // namespace devlearn::fuzz
