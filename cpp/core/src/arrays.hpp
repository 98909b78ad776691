#pragma once

// Lists are short: readying vectors would cost more than they save.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/Core>

namespace devlearn {

// Views of arrays that someone else owns. They are types of each file alone, and so is whatever
// Eigen instantiates over them: a program's own instances, compiled with other flags, never take
// the place of ours.
namespace {

struct Dense : Eigen::Stride<0, 0> {};
using Array = Eigen::Map<Eigen::ArrayXd, Eigen::Unaligned, Dense>;
using ConstArray = Eigen::Map<const Eigen::ArrayXd, Eigen::Unaligned, Dense>;

}  // namespace
}  // namespace devlearn
