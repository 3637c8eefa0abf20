// Writes humble.txt and jazzy.txt: messages of ROS 2 as Foxglove's code writes them, by the definitions
// of either distribution, each read back by its reader. From this folder:
//   npm install --no-save @foxglove/rosmsg-msgs-common@3.2.3 @foxglove/rosmsg2-serialization@3.1.0
//   node write.cjs
const assert = require("assert");
const fs = require("fs");
const distributions = require("@foxglove/rosmsg-msgs-common");
const { MessageReader, MessageWriter } = require("@foxglove/rosmsg2-serialization");

// The values of tests/support/ros2_bytes.h.
const header = (frame_id) => ({ stamp: { sec: 1700000000, nanosec: 500000000 }, frame_id });
const vector = (x, y, z) => ({ x, y, z });
const eighths = (count) => new Float64Array(count).fill(0.125);
const turned = (x, y, z, w) => ({ x, y, z, w });
const twist = { linear: vector(0.5, 0, 0), angular: vector(0, 0, -0.25) };
const messages = {
  "sensor_msgs/Image": {
    header: header("cam"), height: 2, width: 3, encoding: "16UC1", is_bigendian: 0, step: 6,
    data: Uint8Array.from([1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]),
  },
  "sensor_msgs/CompressedImage": {
    header: header("cam"), format: "rgb8; jpeg compressed bgr8",
    data: Uint8Array.from([0xff, 0xd8, 0xff, 0xd9, 7]),
  },
  "nav_msgs/Odometry": {
    header: header("odom"), child_frame_id: "base_link",
    pose: {
      pose: { position: vector(1.5, -2.5, 0.25), orientation: turned(0, 0, 0.6, 0.8) },
      covariance: eighths(36),
    },
    twist: { twist, covariance: eighths(36) },
  },
  "geometry_msgs/Twist": twist,
  "geometry_msgs/TwistStamped": { header: header("base_link"), twist },
  "sensor_msgs/LaserScan": {
    header: header("laser"), angle_min: -1.5, angle_max: 1.5, angle_increment: 1.5,
    time_increment: 0, scan_time: 0.125, range_min: 0.125, range_max: 8,
    ranges: Float32Array.from([1, 2, 4]), intensities: new Float32Array(),
  },
  "sensor_msgs/Range": {
    header: header("sonar"), radiation_type: 0, field_of_view: 0.5, min_range: 0.25, max_range: 4,
    range: 2.5, variance: 0.5,
  },
  "sensor_msgs/Imu": {
    header: header("imu"), orientation: turned(0, 0.6, 0, 0.8), orientation_covariance: eighths(9),
    angular_velocity: vector(0, 0, 0), angular_velocity_covariance: eighths(9),
    linear_acceleration: vector(0.5, -0.25, 9.75), linear_acceleration_covariance: eighths(9),
  },
  "sensor_msgs/BatteryState": {
    header: header("battery"), voltage: 24, temperature: 25, current: -1.5, charge: 5, capacity: 10,
    design_capacity: 12, percentage: 0.5, power_supply_status: 2, power_supply_health: 1,
    power_supply_technology: 2, present: true, cell_voltage: Float32Array.from([12, 12]),
    cell_temperature: new Float32Array(), location: "front", serial_number: "A1",
  },
};

for (const [file, definitions] of [
  ["humble.txt", distributions.ros2humble],
  ["jazzy.txt", distributions.ros2jazzy],
]) {
  const lines = Object.entries(messages).map(([name, message]) => {
    const schema = [definitions[name], ...Object.values(definitions)];
    const bytes = new MessageWriter(schema).writeMessage(message);
    const read = new MessageReader(schema).readMessage(bytes);
    for (const { name: field } of definitions[name].definitions.filter((each) => !each.isConstant)) {
      if (field !== "header") assert.deepEqual(read[field], message[field], `${name}.${field}`);
    }
    return `${name} ${Buffer.from(bytes).toString("hex")}\n`;
  });
  fs.writeFileSync(file, lines.join(""));
}
