// Bytes of a datagram, through Cyclone's own reading of CDR into our conversion: first byte, the
// topic; second, byte order and encoding version; then the sample.
#include <dds/dds.h>
#include <dds/ddsi/ddsi_cdrstream.h>
#include <dds/ddsi/q_protocol.h>

#include <vector>

#include "services/dds/src/wire.h"
#include "services/exchange/bounds.h"
#include "tests/fuzz/fuzz.h"

namespace trailcast::fuzz {
namespace {

// A sample of the type, zeroed, and what Cyclone hangs onto it.
class Sample {
 public:
  explicit Sample(const dds_topic_descriptor_t& type)
      : type_(type), memory_((type.m_size + sizeof(Unit) - 1) / sizeof(Unit)) {}
  ~Sample() { dds_stream_free_sample(memory_.data(), type_.m_ops); }
  Sample(const Sample&) = delete;
  Sample& operator=(const Sample&) = delete;
  [[nodiscard]] char* data() { return reinterpret_cast<char*>(memory_.data()); }

 private:
  using Unit = std::uint64_t;
  const dds_topic_descriptor_t& type_;
  std::vector<Unit> memory_;
};

void TakeIn(exchange::Topic topic, std::uint32_t version, bool swap,
            std::span<const std::uint8_t> input) {
  const dds_topic_descriptor_t& type = dds::TypeOf(topic);
  std::vector<char> bytes(input.begin(), input.end());  // normalised in place
  const auto size = static_cast<std::uint32_t>(bytes.size());
  std::uint32_t end = 0;
  if (!dds_stream_normalize_data(bytes.data(), &end, size, swap, version, type.m_ops)) return;
  Sample sample(type);
  dds_istream_t stream;
  dds_istream_init(&stream, size, bytes.data(), version);
  dds_stream_read(&stream, sample.data(), type.m_ops);
  const auto message = dds::FromWire(topic, sample.data());
  Require(!message || exchange::CheckBounds(*message), "what is taken in is within bounds");
}

}  // namespace
}  // namespace trailcast::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 3) return 0;
  const auto topic = static_cast<trailcast::exchange::Topic>(data[0] % 8);
  const std::uint32_t version = (data[1] & 1U) != 0 ? CDR_ENC_VERSION_2 : CDR_ENC_VERSION_1;
  trailcast::fuzz::TakeIn(topic, version, (data[1] & 2U) != 0, {data + 2, size - 2});
  return 0;
}
