#pragma once

#include "devlearn/record.hpp"

namespace devlearn {

/// Calls column(name, values, dtype) for each column of one value a step; dtype as safetensors
/// names it.
template <typename SomeRecord, typename Column>
void each_step_column(SomeRecord& record, const Column& column) {
  column("round", record.round, "I32");
  column("situation", record.situation, "I64");
  column("motion", record.motion, "I32");
  column("kind", record.kind, "U8");
  column("sef", record.sef, "F64");
  column("smf", record.smf, "F64");
  column("smf_used", record.smf_used, "F64");
  column("collided", record.collided, "BOOL");
  column("arrived", record.arrived, "BOOL");
  column("goal_distance", record.goal_distance, "F64");
  column("clearance", record.clearance, "F64");
  column("event", record.event, "U8");
  column("reduced", record.reduced, "I32");
  column("explored_count", record.explored_count, "I64");
  column("effective_count", record.effective_count, "I64");
}

/// The same for each column of one value a pose.
template <typename SomeRecord, typename Column>
void each_pose_column(SomeRecord& record, const Column& column) {
  column("x", record.x, "F64");
  column("y", record.y, "F64");
  column("heading", record.heading, "F64");
}

}  // namespace devlearn
