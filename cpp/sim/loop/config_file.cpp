#include "loop/config_file.hpp"

#include "file.hpp"
#include "json_fields.hpp"
#include "made_of.hpp"

namespace devlearn {

TrialConfig load_config(const std::string& path) {
  constexpr json::Limits kLimits{std::size_t{4} << 20, 4, 100'000};
  const json::Document document(text_of_file(path, kLimits.bytes), path, kLimits);
  auto config = json::def_at<TrialConfig>(document.root());
  made_of(path, [&] { config.validate(); });
  return config;
}

}  // namespace devlearn
