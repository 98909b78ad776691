#pragma once

#include <string>

#include "devlearn/trial.hpp"

namespace devlearn {

/// A configuration from a JSON file, an object of its fields; those left out keep their defaults.
/// Throws FileError.
TrialConfig load_config(const std::string& path);

}  // namespace devlearn
