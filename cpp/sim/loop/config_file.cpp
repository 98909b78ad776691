#include "loop/config_file.hpp"

#include "file.hpp"
#include "json_fields.hpp"
#include "made_of.hpp"

namespace devlearn {

namespace {

template <typename Def>
Def load(const std::string& path) {
  constexpr json::Limits kLimits{std::size_t{4} << 20, 4, 100'000};
  const json::Document document(text_of_file(path, kLimits.bytes), path, kLimits);
  auto def = json::def_at<Def>(document.root());
  made_of(path, [&] { def.validate(); });
  return def;
}

}  // namespace

TrialConfig load_config(const std::string& path) { return load<TrialConfig>(path); }
RobotDef RobotDef::load(const std::string& path) { return devlearn::load<RobotDef>(path); }

}  // namespace devlearn
