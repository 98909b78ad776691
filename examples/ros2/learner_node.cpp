// A ROS 2 node: a robot on two wheels, with a laser scanner around, learns its way to a target.
//
//     ros2 run devlearn_ros2 learner_node --ros-args -p target_x:=4.0 -p target_y:=4.0
//
// Reads `scan`, the transform from map_frame to base_frame, and `hold` (true while someone else
// drives); writes `cmd_vel`. Let the base stop by itself where commands fall silent, as
// diff_drive_controller's cmd_vel_timeout does: this node is no safety device.
#include <tf2/exceptions.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <geometry_msgs/msg/twist.hpp>
#include <memory>
#include <optional>
#include <rclcpp/rclcpp.hpp>
#include <sensor_msgs/msg/laser_scan.hpp>
#include <std_msgs/msg/bool.hpp>
#include <stdexcept>
#include <string>

#include "devlearn/evaluation.hpp"
#include "devlearn/learner.hpp"
#include "devlearn/situation.hpp"
#include "devlearn/snapshot.hpp"
#include "maneuver.hpp"
#include "senses.hpp"

#if __has_include(<tf2_ros/buffer.hpp>)
#include <tf2_ros/buffer.hpp>
#include <tf2_ros/transform_listener.hpp>
#else  // older distributions
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>
#endif

namespace devlearn_ros2 {

// The motions: degrees turned, then a step ahead. All around, so that the way back is always one.
constexpr std::array<double, 6> kTurns{0.0, 60.0, 120.0, 180.0, -120.0, -60.0};

class LearnerNode : public rclcpp::Node {
 public:
  LearnerNode()
      : Node("learner"),
        file_(declare_parameter("file", std::string("learned.safetensors"))),
        map_frame_(declare_parameter("map_frame", std::string("map"))),
        base_frame_(declare_parameter("base_frame", std::string("base_link"))),
        target_x_(declare_parameter("target_x", 4.0)),
        target_y_(declare_parameter("target_y", 4.0)),
        arrival_(declare_parameter("arrival", 0.3)),
        radius_(declare_parameter("radius", 0.2)),
        margin_(declare_parameter("margin", 0.1)),
        step_(declare_parameter("step", 0.25)),
        mounting_(declare_parameter("scanner_yaw", 0.0)),
        stale_(declare_parameter("stale", 0.5)),
        grid_(declare_parameter("width", 5.0), declare_parameter("height", 5.0), 20, 20, 12,
              {declare_parameter("origin_x", 0.0), declare_parameter("origin_y", 0.0)},
              devlearn::Outside::kClamp),
        learner_(load_or_begin()),
        buffer_(get_clock()),
        listener_(buffer_) {
    learner_.reserve(static_cast<std::size_t>(grid_.count()));
    commands_ = create_publisher<geometry_msgs::msg::Twist>("cmd_vel", 10);
    scans_ = create_subscription<sensor_msgs::msg::LaserScan>(
        "scan", rclcpp::SensorDataQoS(),
        [this](sensor_msgs::msg::LaserScan::ConstSharedPtr scan) { scan_ = scan; });
    holds_ = create_subscription<std_msgs::msg::Bool>(
        "hold", 10, [this](std_msgs::msg::Bool::ConstSharedPtr hold) { held_ = hold->data; });
    timer_ = rclcpp::create_timer(
        this, get_clock(), rclcpp::Duration(std::chrono::milliseconds(50)), [this] { tick(); });
  }

  // Between motions or at the end: it takes as long as the disk does.
  void save() {
    if (learner_.pending()) learner_.cancel();  // nobody will know what came of it
    devlearn::save(learner_, file_);
    RCLCPP_INFO(get_logger(), "saved %zu situations to %s", learner_.situations_experienced(),
                file_.c_str());
  }

 private:
  devlearn::Learner load_or_begin() {
    if (!std::filesystem::exists(file_)) {
      devlearn::LearnerConfig config;
      config.motion_count = static_cast<int>(kTurns.size());
      return devlearn::Learner(config, static_cast<std::uint64_t>(declare_parameter("seed", 1)));
    }
    devlearn::Learner learner = devlearn::load_learner(file_);  // says what is wrong with a file
    if (learner.config().motion_count != static_cast<int>(kTurns.size())) {
      throw std::runtime_error(file_ + " is of a robot with other motions");
    }
    if (learner.pending()) learner.cancel();
    return learner;
  }

  // One tick of control. A motion takes many; the learner is asked and told between two of them.
  void tick() {
    const auto here = pose();
    const bool blind = !here || !scan_fresh();
    if (maneuver_) {
      if (held_ || blind || (maneuver_->driving() && blocked())) maneuver_->preempt();
      // Where it is preempted, the pose is not looked at.
      const Command command = maneuver_->tick(here.value_or(devlearn::Pose()), now().seconds());
      send(command);
      if (maneuver_->outcome() != Outcome::kUnderWay) finish(here);
      return;
    }
    if (held_) return;  // cmd_vel is someone else's
    if (blind) {
      RCLCPP_WARN_THROTTLE(get_logger(), *get_clock(), 5000, "waiting for scan and transform");
      send({});
      return;
    }
    begin(*here);
  }

  void begin(const devlearn::Pose& here) {
    const bool arrived = distance(here) <= arrival_;
    if (arrived && !arrived_) {
      send({});
      save();
    }
    arrived_ = arrived;
    const auto allowed =
        allowed_motions(*scan_, kTurns, step_ + radius_ + margin_, radius_ + margin_, mounting_);
    const bool none = std::none_of(allowed.begin(), allowed.end(), [](bool one) { return one; });
    const auto sef = evaluation(here);
    if (arrived || none || !sef) {  // at the target, shut in, or told too little
      send({});
      return;
    }
    before_ = *sef;
    const int motion = learner_.choose(grid_.situation(here), allowed).motion;
    maneuver_.emplace(here, kTurns[static_cast<std::size_t>(motion)], step_, now().seconds(),
                      Maneuver::Limits());
  }

  void finish(const std::optional<devlearn::Pose>& here) {
    const auto after = here ? evaluation(*here) : std::nullopt;
    const auto smf = after ? lesson(maneuver_->outcome(), before_, *after) : std::nullopt;
    if (smf) {
      learner_.learn(*smf);
    } else {
      learner_.cancel();
    }
    maneuver_.reset();
  }

  double distance(const devlearn::Pose& here) const {
    return std::hypot(here.x - target_x_, here.y - target_y_);
  }

  // SEF; nothing where the scan says too little. The clearance is from the robot's centre, where
  // the scanner is.
  std::optional<double> evaluation(const devlearn::Pose& here) const {
    const auto clearance = nearest_echo(*scan_, 0.0, kPi, mounting_);
    if (!clearance) return std::nullopt;
    return sef_(distance(here), *clearance);
  }

  bool blocked() const {
    const auto free = free_way(*scan_, 0.0, radius_, mounting_);
    return !free || *free < radius_ + margin_;
  }

  bool fresh(const rclcpp::Time& stamp) const {
    return std::abs((now() - stamp).seconds()) <= stale_;
  }

  bool scan_fresh() const { return scan_ && fresh(scan_->header.stamp); }

  std::optional<devlearn::Pose> pose() const {
    try {
      const auto stamped = buffer_.lookupTransform(map_frame_, base_frame_, tf2::TimePointZero);
      if (!fresh(stamped.header.stamp)) return std::nullopt;
      return pose_of(stamped.transform);
    } catch (const tf2::TransformException& error) {
      return std::nullopt;  // not known yet
    }
  }

  void send(const Command& command) {
    geometry_msgs::msg::Twist twist;
    twist.linear.x = command.linear;
    twist.angular.z = command.angular;
    commands_->publish(twist);
  }

  const std::string file_, map_frame_, base_frame_;
  const double target_x_, target_y_, arrival_;  // [m]
  const double radius_, margin_, step_;         // of the robot, around it, of a motion [m]
  const double mounting_, stale_;               // [radians], [s]
  const devlearn::SituationGrid grid_;
  const devlearn::StateEvaluation sef_;
  devlearn::Learner learner_;

  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  rclcpp::Publisher<geometry_msgs::msg::Twist>::SharedPtr commands_;
  rclcpp::Subscription<sensor_msgs::msg::LaserScan>::SharedPtr scans_;
  rclcpp::Subscription<std_msgs::msg::Bool>::SharedPtr holds_;
  rclcpp::TimerBase::SharedPtr timer_;

  // Callbacks come one at a time: rclcpp::spin has one thread.
  sensor_msgs::msg::LaserScan::ConstSharedPtr scan_;
  bool held_ = false, arrived_ = false;
  std::optional<Maneuver> maneuver_;
  double before_ = 0.0;  // SEF, when it began
};

}  // namespace devlearn_ros2

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const auto node = std::make_shared<devlearn_ros2::LearnerNode>();
  rclcpp::spin(node);  // until Ctrl-C
  node->save();
  rclcpp::shutdown();
}
