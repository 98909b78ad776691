#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

#include "devlearn/error.hpp"

namespace devlearn {

/// A file on the side, `path` with ".devlearn-tmp" after it, that either takes the place of `path`
/// as a whole or goes away, so that a full disk or a kill at any moment leaves the previous file
/// whole. It is locked while it is written: who saves to the same path at once waits, and one that
/// a kill left behind is written anew by the next. A link, a pipe or a file of somebody else's at
/// its name is removed, never written to. A file that takes another's place keeps its mode.
class SideFile {
 public:
  /// Throws FileError where no file can be made there, or another writes it for longer than that.
  explicit SideFile(const std::string& path, std::chrono::milliseconds patience = kPatience);
  ~SideFile();
  SideFile(const SideFile&) = delete;
  SideFile& operator=(const SideFile&) = delete;

  void write(const void* data, std::size_t size);
  /// Flushes to the disk, renames, flushes the folder. Throws FileError; then nothing has changed,
  /// unless it was the folder that could not be flushed.
  void commit();

 private:
  static constexpr std::chrono::seconds kPatience{10};

  [[noreturn]] void refuse() const;

  std::string path_, place_, side_;
  int descriptor_ = -1;
};

/// A regular file that is read from its beginning on; pipes and devices, which may never end, are
/// none.
class InputFile {
 public:
  /// Throws FileError where there is no regular file, or none that can be read.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// When it was opened [bytes].
  std::uint64_t size() const noexcept { return size_; }
  /// The next bytes, no more than that; how many they were. Throws FileError.
  std::size_t read(void* into, std::size_t most);

 private:
  [[noreturn]] void refuse(const char* what);

  std::string path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// How much memory this machine has, and a program could address [bytes].
std::uint64_t memory_here();

/// The text of a regular file, of a longer one `most` bytes and another. Throws FileError.
std::string text_of_file(const std::string& path, std::size_t most);

}  // namespace devlearn
