#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "devlearn/adaptive.hpp"
#include "devlearn/detail/fields.hpp"
#include "devlearn/error.hpp"
#include "devlearn/learner.hpp"
#include "safetensors.hpp"

// How a learner's state stands in a snapshot, its own or a trial's.
namespace devlearn {

/// A snapshot's first entries: its format and version, and devlearn's.
safetensors::Metadata preamble(const std::string& format, std::uint64_t version);
/// Throws FileError unless the contents are of this format, of a version up to this one.
void require_format(const safetensors::Contents& contents, const std::string& format,
                    std::uint64_t version, const std::string& source);

/// Adds the state's entries and arrays, which share `state`.
void describe(const std::shared_ptr<const LearnerState>& state, safetensors::Contents& contents);
/// The reverse, checked against every law by building the learner. Throws FileError.
Learner learner_of(const safetensors::Contents& contents, const std::string& source);

/// A learner's own snapshot.
safetensors::Contents contents_of(const Learner& learner);

///@{
/// The same for an adaptive learner.
void describe(const std::shared_ptr<const AdaptiveState>& state, safetensors::Contents& contents);
AdaptiveLearner adaptive_learner_of(const safetensors::Contents& contents,
                                    const std::string& source);
safetensors::Contents contents_of(const AdaptiveLearner& learner);
///@}

/// A generator's state. Throws FileError.
Random::State random_of(const safetensors::Contents& contents, const std::string& source,
                        const char* name = "random");

/// Writes values as metadata entries: numbers so that they read back to the bit, none as 0. Lists
/// become arrays, which point into them.
class EntryWriter {
 public:
  explicit EntryWriter(safetensors::Contents& contents) : contents_(contents) {}
  void operator()(const std::string& name, double value);
  void operator()(const std::string& name, std::uint64_t value);
  void operator()(const std::string& name, std::int64_t value);
  void operator()(const std::string& name, int value);
  void operator()(const std::string& name, bool value);
  void operator()(const std::string& name, const std::optional<double>& value);
  void operator()(const std::string& name, const std::vector<double>& values);
  template <typename Enum>
  void operator()(const std::string& name, Enum value, const std::vector<std::string>& names) {
    contents_.metadata[name] = names.at(static_cast<std::size_t>(value));
  }
  bool lacks(const std::string&) const { return false; }
  /// Which of several Defs a variant holds; nothing for the first.
  template <typename Variant>
  void alternative(const std::string& name, const Variant& value,
                   const std::vector<std::string>& kinds) {
    if (value.index() > 0) contents_.metadata[name] = kinds.at(value.index());
  }

 private:
  safetensors::Contents& contents_;
};

/// The reverse. Throws FileError for an entry that is of another kind, or missing where it may not
/// be none.
class EntryReader {
 public:
  EntryReader(const safetensors::Contents& contents, const std::string& source)
      : contents_(contents), source_(source) {}
  void operator()(const std::string& name, double& value) const;
  void operator()(const std::string& name, std::uint64_t& value) const;
  void operator()(const std::string& name, std::int64_t& value) const;
  void operator()(const std::string& name, int& value) const;
  void operator()(const std::string& name, bool& value) const;
  void operator()(const std::string& name, std::optional<double>& value) const;
  void operator()(const std::string& name, std::vector<double>& values) const;
  template <typename Enum>
  void operator()(const std::string& name, Enum& value,
                  const std::vector<std::string>& names) const {
    value = static_cast<Enum>(option(name, names));
  }
  template <typename Variant>
  void alternative(const std::string& name, Variant& value,
                   const std::vector<std::string>& kinds) const {
    detail::hold(value, has(name) ? option(name, kinds) : 0);
  }
  bool has(const std::string& name) const { return contents_.metadata.count(name) > 0; }
  bool lacks(const std::string& name) const { return !has(name); }

 private:
  template <typename T>
  void number(const std::string& name, T& value, const char* allowed) const;
  std::size_t option(const std::string& name, const std::vector<std::string>& names) const;

  const safetensors::Contents& contents_;
  const std::string& source_;
};

/// Every field of a Def, for either of them: entries by the prefix and the field's name, arrays by
/// its name alone.
template <typename Def, typename Entries>
void each_entry(Def& def, const std::string& prefix, Entries& entries) {
  detail::each_field<std::remove_const_t<Def>>([&](const auto& field) {
    auto& value = def.*field.member;
    using T = std::decay_t<decltype(value)>;
    if (field.may_lack && entries.lacks(prefix + field.name)) return;
    if constexpr (std::is_enum_v<T>) {
      entries(prefix + field.name, value, {field.range.names.begin(), field.range.names.end()});
    } else if constexpr (std::is_same_v<T, std::vector<double>>) {
      entries(field.name, value);
    } else if constexpr (std::is_same_v<std::decay_t<decltype(field.range)>, detail::Nested>) {
      each_entry(value, prefix + field.name + ".", entries);
    } else if constexpr (detail::IsOneOf<std::decay_t<decltype(field.range)>>::value) {
      const std::string within = prefix + field.name + ".";
      entries.alternative(within + "kind", value,
                          {field.range.kinds.begin(), field.range.kinds.end()});
      std::visit([&](auto& alternative) { each_entry(alternative, within, entries); }, value);
    } else {
      entries(prefix + field.name, value);
    }
  });
}

}  // namespace devlearn
