#pragma once

#include <cstddef>
#include <string>

namespace devlearn {

/// A file on the side that either takes the place of `path` as a whole or goes away, so that a full
/// disk or a kill at any moment leaves the previous file whole.
class SideFile {
 public:
  /// Throws FileError where no file can be made there.
  explicit SideFile(const std::string& path);
  ~SideFile();
  SideFile(const SideFile&) = delete;
  SideFile& operator=(const SideFile&) = delete;

  void write(const void* data, std::size_t size);
  /// Flushes to the disk, renames, flushes the folder. Throws FileError; then nothing has changed.
  void commit();

 private:
  [[noreturn]] void refuse() const;

  std::string path_, place_, side_;
  int descriptor_ = -1;
};

}  // namespace devlearn
