#pragma once

#include <string>
#include <utility>
#include <vector>

#include "devlearn/agent.hpp"
#include "devlearn/detail/require.hpp"
#include "excerpt.hpp"
#include "learner_snapshot.hpp"
#include "made_of.hpp"

// How agents with a configuration stand in a state.
namespace devlearn {

/// A state of this kind with the configuration's entries, to which others are added.
template <typename Config>
AgentState state_of(const char* kind, const Config& config) {
  safetensors::Contents contents;
  EntryWriter entries(contents);
  each_entry(config, "", entries);
  return {kind, std::move(contents.metadata), std::move(contents.arrays)};
}

/// The configuration of a state of this kind. Throws FileError.
template <typename Config>
Config config_of(const char* kind, const AgentState& state, const std::string& source) {
  if (state.kind != kind) throw FileError(source, "kind", excerpt(state.kind), kind);
  Config config;
  const safetensors::Contents contents{state.texts, state.arrays};
  const EntryReader entries(contents, source);
  each_entry(config, "", entries);
  made_of(source, [&] { config.validate(); });
  return config;
}

/// Adds an entry to a state.
template <typename T>
void add_entry(AgentState& state, const char* name, T value) {
  safetensors::Contents contents;
  EntryWriter entries(contents);
  entries(name, value);
  state.texts.merge(contents.metadata);
}

/// An entry of a state. Throws FileError.
template <typename T>
T entry_of(const AgentState& state, const char* name, const std::string& source) {
  T value{};
  const safetensors::Contents contents{state.texts, {}};
  EntryReader(contents, source)(name, value);
  return value;
}

/// A row of a table, or a pair of one, that has `count` of them. Throws FileError.
inline std::uint64_t place_of(const AgentState& state, const char* name, std::uint64_t count,
                              const std::string& source) {
  const auto place = entry_of<std::uint64_t>(state, name, source);
  if (place >= count) {
    throw FileError(source, name, std::to_string(place), "below " + std::to_string(count));
  }
  return place;
}

/// The values of an array, each of which `require(value)` lets pass. Throws FileError.
template <typename T, typename Require>
std::vector<T> values_of(const AgentState& state, const char* name, const Shape& shape,
                         const std::string& source, const Require& require) {
  return made_of(source, [&] {
    std::vector<T> values = state.values<T>(name, shape);
    require_each(values.size(), [&](std::size_t i) { require(name, values[i]); });
    return values;
  });
}

}  // namespace devlearn
