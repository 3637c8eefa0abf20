#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// These are messages of ROS 2 as other programs write them: CDR, encoding 1, in hexadecimal, one
// field in each line with the padding before it. They are packed number by number after the .msg
// files of ROS 2 (Humble), by none of this project's code. tests/golden/ros2 has what Foxglove's
// code makes of the same values.
namespace trailcast::test {

struct Ros2Bytes {
  std::string little;  // endian
  std::string big;
};

inline std::string Times(int count, std::string_view hex) {
  std::string all;
  for (int i = 0; i < count; ++i) all += hex;
  return all;
}

inline std::vector<std::uint8_t> FromHex(const std::string& hex) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

// Returns the bytes as they travel and are recorded: behind the four bytes that tell the encoding,
// and before what a newer definition of the message, or a writer that pads, appends.
inline std::vector<std::uint8_t> Recorded(const Ros2Bytes& message, bool little, int more = 0) {
  return FromHex((little ? "00010000" : "00000000") + (little ? message.little : message.big) +
                 Times(more, "7f"));
}

// All of them are stamped 1700000000.5 s.
inline const Ros2Bytes kImage{
    std::string("00f15365")  // stamp, s
        +
        "0065cd1d"                           // and ns
        "0400000063616d00"                   // frame_id "cam"
        "02000000"                           // height
        "03000000"                           // width
        "06000000313655433100"               // encoding
        "00"                                 // is_bigendian
        "0006000000"                         // step
        "0c0000000102030405060708090a0b0c",  // data
    std::string("6553f100")                  // stamp, s
        +
        "1dcd6500"                           // and ns
        "0000000463616d00"                   // frame_id "cam"
        "00000002"                           // height
        "00000003"                           // width
        "00000006313655433100"               // encoding
        "01"                                 // is_bigendian
        "0000000006"                         // step
        "0000000c0102030405060708090a0b0c",  // data
};

inline const Ros2Bytes kCompressedImage{
    std::string("00f15365")  // stamp, s
        +
        "0065cd1d"                                                        // and ns
        "0400000063616d00"                                                // frame_id "cam"
        "1b000000726762383b206a70656720636f6d70726573736564206267723800"  // format
        "0005000000ffd8ffd907",                                           // data
    std::string("6553f100")                                               // stamp, s
        +
        "1dcd6500"                                                        // and ns
        "0000000463616d00"                                                // frame_id "cam"
        "0000001b726762383b206a70656720636f6d70726573736564206267723800"  // format
        "0000000005ffd8ffd907",                                           // data
};

inline const Ros2Bytes kOdometry{
    std::string("00f15365")  // stamp, s
        +
        "0065cd1d"                                                          // and ns
        "050000006f646f6d00"                                                // frame_id "odom"
        "0000000a000000626173655f6c696e6b00"                                // child_frame_id
        "000000000000000000000000f83f00000000000004c0000000000000d03f"      // position
        "00000000000000000000000000000000333333333333e33f9a9999999999e93f"  // orientation
        + Times(36, "000000000000c03f")                                     // covariance
        +
        "000000000000e03f00000000000000000000000000000000"  // linear
        "00000000000000000000000000000000000000000000d0bf"  // angular
        + Times(36, "000000000000c03f"),                    // covariance
    std::string("6553f100")                                 // stamp, s
        +
        "1dcd6500"                                                          // and ns
        "000000056f646f6d00"                                                // frame_id "odom"
        "0000000000000a626173655f6c696e6b00"                                // child_frame_id
        "0000000000003ff8000000000000c0040000000000003fd0000000000000"      // position
        "000000000000000000000000000000003fe33333333333333fe999999999999a"  // orientation
        + Times(36, "3fc0000000000000")                                     // covariance
        +
        "3fe000000000000000000000000000000000000000000000"  // linear
        "00000000000000000000000000000000bfd0000000000000"  // angular
        + Times(36, "3fc0000000000000"),                    // covariance
};

inline const Ros2Bytes kTwist{
    std::string("000000000000e03f00000000000000000000000000000000")  // linear
        + "00000000000000000000000000000000000000000000d0bf",        // angular
    std::string("3fe000000000000000000000000000000000000000000000")  // linear
        + "00000000000000000000000000000000bfd0000000000000",        // angular
};

inline const Ros2Bytes kTwistStamped{
    std::string("00f15365")  // stamp, s
        +
        "0065cd1d"                                              // and ns
        "0a000000626173655f6c696e6b00"                          // frame_id "base_link"
        "0000000000000000e03f00000000000000000000000000000000"  // linear
        "00000000000000000000000000000000000000000000d0bf",     // angular
    std::string("6553f100")                                     // stamp, s
        +
        "1dcd6500"                                              // and ns
        "0000000a626173655f6c696e6b00"                          // frame_id "base_link"
        "00003fe000000000000000000000000000000000000000000000"  // linear
        "00000000000000000000000000000000bfd0000000000000",     // angular
};

inline const Ros2Bytes kLaserScan{
    std::string("00f15365")  // stamp, s
        +
        "0065cd1d"                          // and ns
        "060000006c6173657200"              // frame_id "laser"
        "00000000c0bf"                      // angle_min
        "0000c03f"                          // angle_max
        "0000c03f"                          // angle_increment
        "00000000"                          // time_increment
        "0000003e"                          // scan_time
        "0000003e"                          // range_min
        "00000041"                          // range_max
        "030000000000803f0000004000008040"  // ranges
        "00000000",                         // intensities
    std::string("6553f100")                 // stamp, s
        +
        "1dcd6500"                          // and ns
        "000000066c6173657200"              // frame_id "laser"
        "0000bfc00000"                      // angle_min
        "3fc00000"                          // angle_max
        "3fc00000"                          // angle_increment
        "00000000"                          // time_increment
        "3e000000"                          // scan_time
        "3e000000"                          // range_min
        "41000000"                          // range_max
        "000000033f8000004000000040800000"  // ranges
        "00000000",                         // intensities
};

inline const Ros2Bytes kRange{
    std::string("00f15365")  // stamp, s
        +
        "0065cd1d"              // and ns
        "06000000736f6e617200"  // frame_id "sonar"
        "00"                    // radiation_type
        "000000003f"            // field_of_view
        "0000803e"              // min_range
        "00008040"              // max_range
        "00002040",             // range
    std::string("6553f100")     // stamp, s
        +
        "1dcd6500"              // and ns
        "00000006736f6e617200"  // frame_id "sonar"
        "00"                    // radiation_type
        "003f000000"            // field_of_view
        "3e800000"              // min_range
        "40800000"              // max_range
        "40200000",             // range
};

inline const Ros2Bytes kImu{
    std::string("00f15365")  // stamp, s
        +
        "0065cd1d"                                                          // and ns
        "04000000696d7500"                                                  // frame_id "imu"
        "0000000000000000333333333333e33f00000000000000009a9999999999e93f"  // orientation
        + Times(9, "000000000000c03f")                                      // covariance
        + "000000000000000000000000000000000000000000000000"                // angular_velocity
        + Times(9, "000000000000c03f")                                      // covariance
        + "000000000000e03f000000000000d0bf0000000000802340"                // linear_acceleration
        + Times(9, "000000000000c03f"),                                     // covariance
    std::string("6553f100")                                                 // stamp, s
        +
        "1dcd6500"                                                          // and ns
        "00000004696d7500"                                                  // frame_id "imu"
        "00000000000000003fe333333333333300000000000000003fe999999999999a"  // orientation
        + Times(9, "3fc0000000000000")                                      // covariance
        + "000000000000000000000000000000000000000000000000"                // angular_velocity
        + Times(9, "3fc0000000000000")                                      // covariance
        + "3fe0000000000000bfd00000000000004023800000000000"                // linear_acceleration
        + Times(9, "3fc0000000000000"),                                     // covariance
};

inline const Ros2Bytes kBatteryState{
    std::string("00f15365")  // stamp, s
        +
        "0065cd1d"                  // and ns
        "080000006261747465727900"  // frame_id "battery"
        "0000c041"                  // voltage
        "0000c841"                  // temperature
        "0000c0bf"                  // current
        "0000a040"                  // charge
        "00002041"                  // capacity
        "00004041"                  // design_capacity
        "0000003f"                  // percentage
        "02"                        // power_supply_status
        "01"                        // power_supply_health
        "02"                        // power_supply_technology
        "01"                        // present
        "020000000000404100004041"  // cell_voltage
        "00000000"                  // cell_temperature
        "0600000066726f6e7400"      // location
        "000003000000413100",       // serial_number
    std::string("6553f100")         // stamp, s
        +
        "1dcd6500"                  // and ns
        "000000086261747465727900"  // frame_id "battery"
        "41c00000"                  // voltage
        "41c80000"                  // temperature
        "bfc00000"                  // current
        "40a00000"                  // charge
        "41200000"                  // capacity
        "41400000"                  // design_capacity
        "3f000000"                  // percentage
        "02"                        // power_supply_status
        "01"                        // power_supply_health
        "02"                        // power_supply_technology
        "01"                        // present
        "000000024140000041400000"  // cell_voltage
        "00000000"                  // cell_temperature
        "0000000666726f6e7400"      // location
        "000000000003413100",       // serial_number
};

}  // namespace trailcast::test
