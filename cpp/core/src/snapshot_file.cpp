// Snapshots by path: what is left out where there are no files.
#include <string_view>

#include "devlearn/snapshot.hpp"
#include "file.hpp"
#include "learner_snapshot.hpp"
#include "safetensors.hpp"

namespace devlearn {

void safetensors::write(const Contents& contents, const std::string& path) {
  SideFile file(path);
  write(contents, [&](const std::byte* data, std::size_t size) { file.write(data, size); });
  file.commit();
}

std::vector<std::byte> safetensors::read_file(const std::string& path) {
  InputFile file(path);
  std::vector<std::byte> bytes(kLengthBytes);
  bytes.resize(file.read(bytes.data(), bytes.size()));
  const std::size_t length = header_length(bytes.data(), file.size(), path);
  bytes.resize(kLengthBytes + length);
  bytes.resize(kLengthBytes + file.read(bytes.data() + kLengthBytes, length));
  const std::string_view header(reinterpret_cast<const char*>(bytes.data()) + kLengthBytes,
                                bytes.size() - kLengthBytes);
  const std::uint64_t described = data_described(header, path);
  const std::uint64_t data_size = file.size() - kLengthBytes - length;
  if (described != data_size) {
    throw FileError(path, "", std::to_string(data_size) + " bytes of data",
                    std::to_string(described) + ", as the header describes");
  }
  const std::uint64_t memory = memory_here();
  if (file.size() > memory) {
    throw FileError(path, "", std::to_string(file.size()) + " bytes",
                    "at most " + std::to_string(memory) + ", the memory of this machine");
  }
  const std::size_t begun = bytes.size();
  bytes.resize(static_cast<std::size_t>(file.size()));
  bytes.resize(begun + file.read(bytes.data() + begun, bytes.size() - begun));
  return bytes;
}

void save(const Learner& learner, const std::string& path) {
  safetensors::write(contents_of(learner), path);
}

void save(const AdaptiveLearner& learner, const std::string& path) {
  safetensors::write(contents_of(learner), path);
}

AdaptiveLearner load_adaptive_learner(const std::string& path) {
  const std::vector<std::byte> bytes = safetensors::read_file(path);
  return load_adaptive_learner(bytes.data(), bytes.size(), path);
}

Learner load_learner(const std::string& path) {
  const std::vector<std::byte> bytes = safetensors::read_file(path);
  return load_learner(bytes.data(), bytes.size(), path);
}

}  // namespace devlearn
