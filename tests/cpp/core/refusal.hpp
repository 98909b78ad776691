#pragma once

#include <doctest/doctest.h>

#include <string>

#include "devlearn/error.hpp"

/// Checks that `call` throws InvalidValue that names this quantity and value, and says what is
/// allowed.
template <class Call>
void check_refused(Call call, const std::string& quantity, const std::string& value) {
  CAPTURE(quantity);
  CAPTURE(value);
  bool refused = false;
  try {
    call();
  } catch (const devlearn::InvalidValue& error) {
    refused = true;
    CHECK(error.quantity() == quantity);
    CHECK(error.value() == value);
    CHECK_FALSE(error.allowed().empty());
    CHECK(error.what() == quantity + ": got " + value + "; expected " + error.allowed());
  }
  CHECK_MESSAGE(refused, "expected InvalidValue");
}
