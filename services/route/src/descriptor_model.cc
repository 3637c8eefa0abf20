#include "services/route/src/descriptor_model.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "services/route/src/descriptor_table.h"

namespace trailcast::route {
namespace {

constexpr int kWeightUnit = 16;    // of Logistic's argument for each unit of a sum
constexpr int kLikeWeight = 480;   // log odds of 1.9
constexpr int kShareOfModel = 10;  // out of kWeightUnit, if a similar descriptor is known

}  // namespace

void CodeDescriptor(BitCoder& coder, Descriptor& descriptor, const Descriptor* like) {
  std::array<int, kDescriptorBits> sign{};
  for (std::size_t i = 0; i < kDescriptorBits; ++i) {
    const DescriptorBit& model = kDescriptorTable[i];
    int sum = model.bias;
    for (std::size_t k = 0; k < kWitnesses; ++k) {
      sum += model.weights[k] * sign[model.witnesses[k]];
    }
    const unsigned mask = 1U << (i % 8);
    std::uint8_t& byte = descriptor[i / 8];
    int z = sum * kWeightUnit;
    if (like != nullptr) {
      const bool set = ((*like)[i / 8] & mask) != 0;
      z = sum * kShareOfModel + (set ? kLikeWeight : -kLikeWeight);
    }
    const bool set = coder.Code((byte & mask) != 0, Logistic(z));
    byte = static_cast<std::uint8_t>(set ? byte | mask : byte & ~mask);
    sign[i] = set ? 1 : -1;
  }
}

}  // namespace trailcast::route
