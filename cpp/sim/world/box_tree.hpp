#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "devlearn/world.hpp"

namespace devlearn {

/// A rectangle with sides along the axes.
struct Box {
  Point low, high;

  bool contains(Point p) const noexcept {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  }
  bool overlaps(const Box& other) const noexcept {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
           other.low.y <= high.y;
  }
  Box grown_by(double margin) const noexcept {
    return {{low.x - margin, low.y - margin}, {high.x + margin, high.y + margin}};
  }
  /// The least box that holds this and another.
  Box joined(const Box& other) const noexcept {
    return {{std::min(low.x, other.low.x), std::min(low.y, other.low.y)},
            {std::max(high.x, other.high.x), std::max(high.y, other.high.y)}};
  }
  /// Of the nearest points of this and another; 0 where they overlap.
  double squared_distance(const Box& other) const noexcept {
    const double x = std::max({0.0, low.x - other.high.x, other.low.x - high.x});
    const double y = std::max({0.0, low.y - other.high.y, other.low.y - high.y});
    return x * x + y * y;
  }
  /// Twice where its middle is.
  Point doubled_middle() const noexcept { return {low.x + high.x, low.y + high.y}; }
};

/// A bounding volume hierarchy over boxes: finds those near a place in a time that grows with the
/// logarithm of their number.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box>& boxes) {
    if (boxes.empty()) return;
    items_.resize(boxes.size());
    for (std::size_t i = 0; i < items_.size(); ++i) items_[i] = static_cast<std::uint32_t>(i);
    nodes_.reserve(2 * boxes.size());
    build(boxes, 0, items_.size());
  }

  /// Calls meet(i) for all boxes i whose squared distance from `place` is at most `limit`, and for
  /// some others; nearer ones tend to come first. meet may lower the limit as it finds what it
  /// looks for; below zero it ends the search.
  template <typename Meet>
  void search(const Box& place, double& limit, const Meet& meet) const {
    if (nodes_.empty()) return;
    struct Waiting {
      std::uint32_t node;
      double distance;
    };
    std::array<Waiting, kDepth> waiting;
    std::size_t count = 0;
    waiting[count++] = {0, nodes_[0].box.squared_distance(place)};
    while (count > 0) {
      const Waiting next = waiting[--count];
      if (next.distance > limit) continue;
      const Node& node = nodes_[next.node];
      if (node.count > 0) {
        for (std::uint32_t k = node.first; k < node.first + node.count; ++k) meet(items_[k]);
        continue;
      }
      const std::uint32_t left = next.node + 1, right = node.first;
      const Waiting parts[] = {{left, nodes_[left].box.squared_distance(place)},
                               {right, nodes_[right].box.squared_distance(place)}};
      const int near = parts[1].distance < parts[0].distance ? 1 : 0;
      waiting[count++] = parts[1 - near];
      waiting[count++] = parts[near];
    }
  }

 private:
  static constexpr std::size_t kLeaf = 8;    // boxes in a leaf, at most
  static constexpr std::size_t kDepth = 40;  // halvings of 2^32 boxes, and some

  struct Node {
    Box box;
    std::uint32_t first = 0;  // of a leaf: of its part of items_; else the node's right part
    std::uint32_t count = 0;  // of a leaf's boxes; else 0, and the left part comes next
  };

  // Halves by number, across the longer side of where the middles are.
  void build(const std::vector<Box>& boxes, std::size_t begin, std::size_t end) {
    const std::size_t here = nodes_.size();
    Box all = boxes[items_[begin]];
    Box middles{all.doubled_middle(), all.doubled_middle()};
    for (std::size_t k = begin + 1; k < end; ++k) {
      const Box& box = boxes[items_[k]];
      all = all.joined(box);
      middles = middles.joined({box.doubled_middle(), box.doubled_middle()});
    }
    nodes_.push_back(
        {all, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end - begin)});
    if (end - begin <= kLeaf) return;
    const bool wide = middles.high.x - middles.low.x >= middles.high.y - middles.low.y;
    const std::size_t half = begin + (end - begin) / 2;
    const auto at = [this](std::size_t k) {
      return items_.begin() + static_cast<std::ptrdiff_t>(k);
    };
    std::nth_element(at(begin), at(half), at(end), [&](std::uint32_t a, std::uint32_t b) {
      const Point p = boxes[a].doubled_middle(), q = boxes[b].doubled_middle();
      return wide ? p.x < q.x : p.y < q.y;
    });
    build(boxes, begin, half);
    nodes_[here].first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[here].count = 0;
    build(boxes, half, end);
  }

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
};

}  // namespace devlearn
