#include "services/dds/src/qos_table.h"

#include <array>

#include "services/exchange/topics.h"

namespace trailcast::dds {
namespace {

using T = exchange::Topic;
using std::chrono::milliseconds;

constexpr milliseconds kForever{0};
// This allows three missed heartbeats on a bad radio link, and is still soon enough for people to
// notice.
constexpr milliseconds kAgentLease{3000};

struct Row {
  T topic;
  TopicQos qos;
};

// No topic keeps all samples: a writer would wait for a dead or hanging reader until its lease is
// over (10 s), and everybody else would wait as well. A client without an answer, or with a lost
// segment, asks again, and it requests no more segments at once than its link carries
// (exchange::WantList). 256 batches of segments are 12 MB on either side.
// clang-format off
constexpr std::array kTable = {
    // topic            transient-local  keep last  liveliness
    Row{T::kRoutes,           {true,     1,         kForever}},
    Row{T::kSegments,         {false,    256,       kForever}},
    Row{T::kSegmentRequests,  {false,    16,        kForever}},
    Row{T::kReceipts,         {true,     1,         kForever}},
    Row{T::kCatalogRequests,  {false,    16,        kForever}},
    Row{T::kCatalogReplies,   {false,    16,        kForever}},
    Row{T::kAgents,           {true,     1,         kAgentLease}},
    Row{T::kRouteEdits,       {false,    16,        kForever}},
    Row{T::kFleet,            {true,     1,         kForever}},
    Row{T::kNeighbours,       {false,    1,         kForever, /*best_effort=*/true}},
    Row{T::kNow,              {false,    16,        kForever}},
    Row{T::kNowAnswers,       {false,    16,        kForever}},
    Row{T::kMissions,         {false,    16,        kForever}},
    Row{T::kMissionStates,    {false,    16,        kForever}},
    Row{T::kMissionRequests,  {false,    16,        kForever}},
    Row{T::kMissionReplies,   {false,    16,        kForever}},
    Row{T::kDrives,           {false,    1,         kForever, /*best_effort=*/true}},
    Row{T::kSnapshotRequests, {false,    1,         kForever, /*best_effort=*/true}},
    Row{T::kSnapshots,        {false,    1,         kForever, /*best_effort=*/true}},
    Row{T::kNetworkEdits,     {false,    16,        kForever}},
    Row{T::kNetworkRequests,  {false,    16,        kForever}},
    Row{T::kNetworkReplies,   {false,    16,        kForever}},
    Row{T::kFollowed,         {false,    16,        kForever}},
    Row{T::kReachRequests,    {false,    16,        kForever, /*best_effort=*/true}},
    Row{T::kReachReports,     {false,    16,        kForever}},
    Row{T::kStores,           {false,    64,        kForever}},
    Row{T::kPhotos,           {false,    16,        kForever}},
    Row{T::kPhotoRequests,    {false,    16,        kForever}},
};
// clang-format on

constexpr bool RowsAreInTopicOrder() {
  if (kTable.size() != exchange::kTopics) return false;
  for (std::size_t i = 0; i < kTable.size(); ++i) {
    if (static_cast<std::size_t>(kTable[i].topic) != i) return false;
  }
  return true;
}
static_assert(RowsAreInTopicOrder());

}  // namespace

const TopicQos& QosOf(exchange::Topic topic) { return kTable[static_cast<std::size_t>(topic)].qos; }

Qos MakeQos(const TopicQos& of, const std::vector<std::string>& partitions) {
  const auto nanoseconds = [](milliseconds t) { return DDS_MSECS(t.count()); };
  Qos qos = MakeQos();
  dds_qset_reliability(qos.get(),
                       of.best_effort ? DDS_RELIABILITY_BEST_EFFORT : DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, of.keep_last);
  if (of.transient_local) {
    dds_qset_durability(qos.get(), DDS_DURABILITY_TRANSIENT_LOCAL);
    // The durability service, not the history, decides what late joiners get.
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, of.keep_last,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  }
  if (of.liveliness > kForever) {
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, nanoseconds(of.liveliness));
  }
  dds_qset_writer_data_lifecycle(qos.get(), true);
  std::vector<const char*> names;  // "" alone stands for no partitions
  for (const std::string& partition : partitions) names.push_back(partition.c_str());
  dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
  dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
  return qos;
}

Qos MakeOverhearingQos(const TopicQos& of, const std::vector<std::string>& partitions) {
  Qos qos = MakeQos(of, partitions);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_BEST_EFFORT, 0);
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  return qos;
}

}  // namespace trailcast::dds
