#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "devlearn/error.hpp"

namespace devlearn {

/// A file on the side, `path` with ".devlearn-tmp" after it, that either takes the place of `path`
/// as a whole or goes away, so that a full disk or a kill at any moment leaves the previous file
/// whole. It is locked while it is written: who saves to the same path at once waits, and one that
/// a kill left behind is written anew by the next.
class SideFile {
 public:
  /// Throws FileError where no file can be made there.
  explicit SideFile(const std::string& path);
  ~SideFile();
  SideFile(const SideFile&) = delete;
  SideFile& operator=(const SideFile&) = delete;

  void write(const void* data, std::size_t size);
  /// Flushes to the disk, renames, flushes the folder. Throws FileError; then nothing has changed,
  /// unless it was the folder that could not be flushed.
  void commit();

 private:
  [[noreturn]] void refuse() const;

  std::string path_, place_, side_;
  int descriptor_ = -1;
};

/// The whole of a regular file, in memory bounded by its size. Throws FileError.
std::vector<std::byte> bytes_of_file(const std::string& path);
/// The text of a file of any kind, of a longer one `most` bytes and another. Throws FileError.
std::string text_of_file(const std::string& path, std::size_t most);

/// What `make` makes of a file's values; what it refuses is refused as the file's fault.
template <typename Make>
auto made_of(const std::string& source, const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const FileError&) {
    throw;
  } catch (const InvalidValue& error) {
    throw FileError(source, error.quantity(), error.value(), error.allowed());
  }
}

}  // namespace devlearn
