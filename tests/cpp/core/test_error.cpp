#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "devlearn/detail/require.hpp"
#include "devlearn/error.hpp"
#include "devlearn/random.hpp"
#include "refusal.hpp"

using namespace devlearn;

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
}  // namespace

TEST_CASE("a refusal names quantity, value and what is allowed, and is an invalid_argument") {
  const InvalidValue error("eta", "7", "in (0, 1)");
  CHECK(error.quantity() == "eta");
  CHECK(error.value() == "7");
  CHECK(error.allowed() == "in (0, 1)");
  CHECK(std::string(error.what()) == "eta: got 7; expected in (0, 1)");
  CHECK_THROWS_AS(throw error, std::invalid_argument);
}

TEST_CASE("a file's refusal names file and field too, and is caught as any other") {
  const FileError error("a.json", "obstacles[2].radius", "-1", "in [0.01, 1000] m");
  CHECK(error.file() == "a.json");
  CHECK(error.field() == "obstacles[2].radius");
  CHECK(error.quantity() == error.field());
  CHECK(std::string(error.what()) ==
        "a.json: obstacles[2].radius: got -1; expected in [0.01, 1000] m");
  CHECK_THROWS_AS(throw error, InvalidValue);

  const FileError whole("a.json", "", "nothing", "a JSON object");
  CHECK(std::string(whole.what()) == "a.json: got nothing; expected a JSON object");
}

TEST_CASE("a closed interval has both ends") {
  CHECK_NOTHROW(require_in("q", 0.0, 0.0, 1.0));
  CHECK_NOTHROW(require_in("q", 1.0, 0.0, 1.0));
  check_refused([] { require_in("q", -5e-324, 0.0, 1.0); }, "q", "-5e-324");
  check_refused([] { require_in("q", std::nextafter(1.0, 2.0), 0.0, 1.0); }, "q",
                "1.0000000000000002");
}

TEST_CASE("an open interval has neither end") {
  CHECK_NOTHROW(require_between("q", 5e-324, 0.0, 1.0));
  CHECK_NOTHROW(require_between("q", std::nextafter(1.0, 0.0), 0.0, 1.0));
  check_refused([] { require_between("q", 0.0, 0.0, 1.0); }, "q", "0");
  check_refused([] { require_between("q", 1.0, 0.0, 1.0); }, "q", "1");
}

TEST_CASE("a half-open interval has its upper end only") {
  CHECK_NOTHROW(require_above("q", 5e-324, 0.0, 1.0));
  CHECK_NOTHROW(require_above("q", 1.0, 0.0, 1.0));
  check_refused([] { require_above("q", 0.0, 0.0, 1.0); }, "q", "0");
  check_refused([] { require_above("q", std::nextafter(1.0, 2.0), 0.0, 1.0); }, "q",
                "1.0000000000000002");
}

TEST_CASE("a count's range has both ends") {
  CHECK_NOTHROW(require_count("q", 1, 1, 3));
  CHECK_NOTHROW(require_count("q", 3, 1, 3));
  check_refused([] { require_count("q", 0, 1, 3); }, "q", "0");
  check_refused([] { require_count("q", 4, 1, 3); }, "q", "4");
}

TEST_CASE("NaN and infinities lie in no interval of finite ends") {
  for (const double value : {kNaN, kInfinity, -kInfinity}) {
    const std::string text = to_text(value);
    check_refused([=] { require_in("q", value, -1e308, 1e308); }, "q", text);
    check_refused([=] { require_between("q", value, -1e308, 1e308); }, "q", text);
    check_refused([=] { require_above("q", value, -1e308, 1e308); }, "q", text);
  }
}

TEST_CASE("a refused range is told with its unit and its kind of ends") {
  const auto allowed = [](auto require) {
    try {
      require("q", 7.0, 0.0, 2.5, "m");
    } catch (const InvalidValue& error) {
      return error.allowed();
    }
    return std::string();
  };
  CHECK(allowed(require_in) == "in [0, 2.5] m");
  CHECK(allowed(require_between) == "in (0, 2.5) m");
  CHECK(allowed(require_above) == "in (0, 2.5] m");
}

TEST_CASE("the text of a number reads back as the same number") {
  CHECK(to_text(0.1) == "0.1");
  CHECK(to_text(-3.0) == "-3");
  Random random(1, "text");
  int wrong = 0;
  for (int i = 0; i < 100000; ++i) {
    const double value =
        std::ldexp(random.uniform() - 0.5, static_cast<int>(random.index(600)) - 300);
    wrong += std::strtod(to_text(value).c_str(), nullptr) != value;
  }
  CHECK(wrong == 0);
}
