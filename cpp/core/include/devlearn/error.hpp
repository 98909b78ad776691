#pragma once

#include <stdexcept>
#include <string>

#include "devlearn/detail/cpp17.hpp"

namespace devlearn {

/// A value or a call that devlearn refuses. It says which quantity, what was given, and what is
/// allowed; the object that refused is left as it was.
class InvalidValue : public std::invalid_argument {
 public:
  /// what() is made of the three.
  InvalidValue(std::string quantity, std::string value, std::string allowed);

  /// Which, such as `LearnerConfig.sigma`.
  const std::string& quantity() const noexcept { return quantity_; }
  /// What was given.
  const std::string& value() const noexcept { return value_; }
  /// What is allowed.
  const std::string& allowed() const noexcept { return allowed_; }

 protected:
  /// With a message of one's own.
  InvalidValue(const std::string& message, std::string quantity, std::string value,
               std::string allowed);

 private:
  std::string quantity_, value_, allowed_;
};

/// The same for a file: it also says which file and, where there is one, which field.
class FileError : public InvalidValue {
 public:
  /// what() is made of the four.
  FileError(std::string file, std::string field, std::string value, std::string allowed);

  /// Path of the file, or what stands for it.
  const std::string& file() const noexcept { return file_; }
  /// Path of the field within the file, such as `obstacles[2].radius`; empty for the whole file.
  const std::string& field() const noexcept { return quantity(); }

 private:
  std::string file_;
};

/// The shortest decimal text that reads back as `value`; for messages and files.
std::string to_text(double value);

/// Throws InvalidValue. Headers do it by this: they are read by programs, too, that are compiled
/// without exceptions, in which a refusal ends the program.
[[noreturn]] void refuse(std::string quantity, std::string value, std::string allowed);

}  // namespace devlearn
