#include "devlearn/detail/option_model.hpp"

#include <algorithm>
#include <utility>

namespace devlearn::detail {
namespace {

constexpr double kLeast = 1e-6;  // what is less probable is not kept

}  // namespace

double OptionModel::probability(Row row, Row end) const noexcept {
  for (const Ending& ending : endings_[row]) {
    if (ending.row == end) return ending.probability;
  }
  return 0.0;
}

double OptionModel::probability(Row row) const noexcept {
  return mean(row, [](Row) { return 1.0; });
}

void OptionModel::learn(Row row, double reward, Row next, bool ended, double alpha, double gamma,
                        std::size_t most) {
  const bool goes_on = !ended && next != kNoRow;
  const double future = goes_on ? gamma * reward_[next] : 0.0;
  reward_[row] = ValueTable::bounded(reward_[row] + alpha * (reward + future - reward_[row]));

  const std::vector<Ending> known = std::move(endings_[row]);
  const std::vector<Ending> sample = ended         ? std::vector<Ending>{{next, 1.0}}
                                     : !goes_on    ? std::vector<Ending>{}
                                     : next == row ? known
                                                   : endings_[next];
  std::vector<Ending>& mixed = endings_[row];
  mixed.clear();
  auto old = known.begin();
  for (const Ending& ending : sample) {
    for (; old != known.end() && old->row < ending.row; ++old) {
      mixed.push_back({old->row, (1.0 - alpha) * old->probability});
    }
    const bool both = old != known.end() && old->row == ending.row;
    const double before = both ? (old++)->probability : 0.0;
    mixed.push_back({ending.row, (1.0 - alpha) * before + alpha * gamma * ending.probability});
  }
  for (; old != known.end(); ++old) {
    mixed.push_back({old->row, (1.0 - alpha) * old->probability});
  }
  const auto negligible = [](const Ending& ending) { return ending.probability < kLeast; };
  mixed.erase(std::remove_if(mixed.begin(), mixed.end(), negligible), mixed.end());
  while (mixed.size() > most) {
    mixed.erase(std::min_element(mixed.begin(), mixed.end(), [](const Ending& a, const Ending& b) {
      return a.probability < b.probability;
    }));
  }
}

}  // namespace devlearn::detail
