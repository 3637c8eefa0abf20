#pragma once

#include <dds/dds.h>

#include <functional>
#include <optional>

#include "services/dds/ros2_link.h"

// These convert between the messages of ros2_link.h and idl/ros2.idl's C types.
namespace trailcast::dds {

using UseSample = std::function<Result<void>(const void* sample)>;

[[nodiscard]] const dds_topic_descriptor_t& ImageType(bool compressed);
[[nodiscard]] const dds_topic_descriptor_t& OdometryType();
[[nodiscard]] const dds_topic_descriptor_t& ScanType();
[[nodiscard]] const dds_topic_descriptor_t& RangeType();
[[nodiscard]] const dds_topic_descriptor_t& ImuType();
[[nodiscard]] const dds_topic_descriptor_t& BatteryType();
[[nodiscard]] const dds_topic_descriptor_t& CommandType(Ros2CommandType type);

// Calls `use` with the sample, which is valid during the call and borrows the message's bytes.
[[nodiscard]] Result<void> WithRos2Wire(const Ros2Image& image, const UseSample& use);
[[nodiscard]] Result<void> WithRos2Wire(const Ros2Odometry& odometry, const UseSample& use);
[[nodiscard]] Result<void> WithRos2Wire(const Ros2Scan& scan, const UseSample& use);
[[nodiscard]] Result<void> WithRos2Wire(const Ros2Range& range, const UseSample& use);
[[nodiscard]] Result<void> WithRos2Wire(const Ros2Imu& imu, const UseSample& use);
[[nodiscard]] Result<void> WithRos2Wire(const Ros2Battery& battery, const UseSample& use);
[[nodiscard]] Result<void> WithRos2Wire(const Ros2Command& command, Ros2CommandType type,
                                        const UseSample& use);

// These return nothing if the sample has invalid numbers, or a scan or range that no sensor can
// give.
[[nodiscard]] Ros2Sensed ImageFromWire(const void* sample, bool compressed);
// The error tells people which number is invalid.
[[nodiscard]] Result<Ros2Odometry> OdometryFromWire(const void* sample);
[[nodiscard]] std::optional<Ros2Scan> ScanFromWire(const void* sample);
[[nodiscard]] std::optional<Ros2Range> RangeFromWire(const void* sample, std::size_t sensor);
[[nodiscard]] std::optional<Ros2Imu> ImuFromWire(const void* sample);
[[nodiscard]] Ros2Battery BatteryFromWire(const void* sample);
[[nodiscard]] std::optional<Ros2Command> CommandFromWire(const void* sample, Ros2CommandType type);

}  // namespace trailcast::dds
