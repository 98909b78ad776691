#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "devlearn/error.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/snapshot.hpp"
#include "file.hpp"

// What a save does to what was there, and what a read dares to open.
using namespace devlearn;
namespace fs = std::filesystem;

namespace {

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "devlearn.XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string content(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

void write_aside(const std::string& path, const std::string& text) {
  SideFile file(path);
  file.write(text.data(), text.size());
  file.commit();
}

unsigned mode(const std::string& path) {
  struct stat status {};
  ::stat(path.c_str(), &status);
  return status.st_mode & 07777U;
}

const std::string kSide = ".devlearn-tmp";

}  // namespace

TEST_CASE("a file that is saved again keeps its mode, a new one has what the umask leaves") {
  const Folder folder;
  for (const unsigned kept : {0600U, 0640U, 0666U, 0444U}) {
    const std::string path = folder / std::to_string(kept);
    write(path, "old");
    ::chmod(path.c_str(), kept);
    write_aside(path, "new");
    CHECK(content(path) == "new");
    CHECK(mode(path) == kept);
  }
  const auto before = ::umask(027);
  write_aside(folder / "fresh", "new");
  ::umask(before);
  CHECK(mode(folder / "fresh") == 0640U);
}

TEST_CASE("what lies at the side file's name is replaced, and what it leads to stays as it was") {
  const Folder folder;
  write(folder / "victim", "mine");
  const std::string side = folder / "a" + kSide;
  SUBCASE("a hard link") { fs::create_hard_link(folder / "victim", side); }
  SUBCASE("a symbolic link") { fs::create_symlink(folder / "victim", side); }
  SUBCASE("a link to nowhere") { fs::create_symlink(folder / "nowhere", side); }
  SUBCASE("a pipe") { REQUIRE(::mkfifo(side.c_str(), 0666) == 0); }
  SUBCASE("a file that a kill left") { write(side, std::string(10000, 'x')); }
  write_aside(folder / "a", "new");
  CHECK(content(folder / "a") == "new");
  CHECK(content(folder / "victim") == "mine");
  CHECK_FALSE(fs::exists(fs::symlink_status(side)));
  CHECK_FALSE(fs::exists(folder / "nowhere"));
}

TEST_CASE("a folder at the side file's name is refused") {
  const Folder folder;
  write(folder / "a", "old");
  fs::create_directory(folder / "a" + kSide);
  CHECK_THROWS_AS(write_aside(folder / "a", "new"), FileError);
  CHECK(content(folder / "a") == "old");
}

TEST_CASE("a save gives up on a file that another writes for too long, and says so") {
  using std::chrono::milliseconds;
  const Folder folder;
  const std::string side = folder / "a" + kSide;
  const int held = ::open(side.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  REQUIRE(::flock(held, LOCK_EX) == 0);
  const auto began = std::chrono::steady_clock::now();
  std::string said;
  try {
    const SideFile file(folder / "a", milliseconds(50));
  } catch (const FileError& error) {
    said = error.what();
  }
  CHECK(said.find("being written by another for 50 ms") != std::string::npos);
  CHECK(std::chrono::steady_clock::now() - began >= milliseconds(50));
  ::close(held);
  write_aside(folder / "a", "new");
  CHECK(content(folder / "a") == "new");
}

TEST_CASE("pipes and devices are not read") {
  const Folder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0666) == 0);
  for (const std::string& path : {folder / "pipe", std::string("/dev/zero"), folder / ""}) {
    CHECK_THROWS_AS(InputFile file(path), FileError);
    CHECK_THROWS_AS(text_of_file(path, 100), FileError);
    CHECK_THROWS_AS(load_learner(path), FileError);
  }
}

TEST_CASE("a snapshot of holes is refused before memory is taken for it") {
  const Folder folder;
  const std::string path = folder / "sparse";
  save(Learner(), path);
  fs::resize_file(path, std::uintmax_t{60} << 30);
  std::string said;
  try {
    load_learner(path);
  } catch (const FileError& error) {
    said = error.what();
  }
  CHECK(said.find("as the header describes") != std::string::npos);
  write(folder / "zeros", "");
  fs::resize_file(folder / "zeros", std::uintmax_t{60} << 30);
  CHECK_THROWS_AS(load_learner(folder / "zeros"), FileError);
}
