#include "services/view/view_index.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "services/view/src/view_words.h"

namespace trailcast::view {
namespace {

constexpr std::uint32_t kMostSlots = kWords - 1;  // the last is kNoEntry's
// These values replace a slot's route.
constexpr std::uint32_t kDead = 0xFFFFFFFFU;
constexpr std::uint32_t kFree = 0xFFFFFFFEU;
constexpr std::size_t kBytesARoute = 192;  // a key, its text, a node of a map
// So many chunks of one word are searched: a word that is more common tells next to nothing.
constexpr int kMostChunks = 64;
// So many features of a view vote. They are the first, which are the strongest, as they take most
// of the time. More vote if they are of all sizes, because a key view has a part of those.
constexpr std::size_t kMostVoters = 80;
constexpr std::size_t kMostVotersOfAllSizes = 320;
// So many features of a segment are kept, the first ones: more than teaching keeps would only fill
// the memory.
constexpr std::size_t kMostFeatures = 64;
// This is added to a segment's number of features when its votes are divided by it.
constexpr std::uint32_t kUsualFeatures = 10;
constexpr int kMostVotes = 0xFFFF;
// Entries of removed segments stay until there are so many of them that a pass over the tables is
// worth it. They are few, so that a small fleet's server does not grow by what it no longer has.
constexpr std::size_t kSweepFrom = 64;

// Returns what a segment is found by: the features of its key views, the strongest of each first. A
// segment from before there were any has its own features.
std::vector<route::Descriptor> DescriptorsOf(const route::Segment& segment) {
  std::vector<route::Descriptor> descriptors;
  const auto add = [&](const route::Descriptor& descriptor) {
    if (descriptors.size() < kMostFeatures && route::IsDescribed(descriptor)) {
      descriptors.push_back(descriptor);
    }
  };
  for (const route::Feature& feature : segment.features) add(feature.descriptor);
  if (!descriptors.empty()) return descriptors;
  std::size_t longest = 0;
  for (const route::KeyView& view : segment.key_views) {
    longest = std::max(longest, view.features.size());
  }
  for (std::size_t i = 0; i < longest; ++i) {
    for (const route::KeyView& view : segment.key_views) {
      if (i < view.features.size()) add(view.features[i].descriptor);
    }
  }
  return descriptors;
}

// Returns the least size above 0, which is that of a feature whose size is known.
float LeastSize_px(std::span<const route::ViewFeature> view) {
  float least_px = std::numeric_limits<float>::max();
  for (const route::ViewFeature& feature : view) {
    if (feature.size_px > 0.0F) least_px = std::min(least_px, feature.size_px);
  }
  return least_px;
}

std::size_t OctaveOf(float size, std::size_t octaves) {
  std::size_t octave = 0;
  while (size >= 2.0F && octave + 1 < octaves) {
    size /= 2.0F;
    ++octave;
  }
  return octave;
}

}  // namespace

ViewIndex::ViewIndex(const ViewIndexOptions& options)
    : options_{std::min(options.most_segments, kMostSlots), options.most_bytes},
      heads_(kTables * kWords) {}

ViewIndex::Route& ViewIndex::RouteOf(const route::RouteKey& key) {
  const auto [known, added] = routes_.try_emplace(key);
  Route& route = known->second;
  if (!added) return route;
  if (free_numbers_.empty()) {
    free_numbers_.push_back(static_cast<std::uint32_t>(keys_.size()));
    keys_.push_back(nullptr);
  }
  route.number = free_numbers_.back();
  free_numbers_.pop_back();
  keys_[route.number] = &known->first;
  return route;
}

std::optional<std::uint32_t> ViewIndex::TakeSlot() {
  if (full()) return std::nullopt;
  if (free_slots_.empty() && slots_.size() >= options_.most_segments) Sweep();
  if (free_slots_.empty()) {
    slots_.emplace_back();
    tallies_.emplace_back();
    return static_cast<std::uint32_t>(slots_.size() - 1);
  }
  const std::uint32_t slot = free_slots_.back();
  free_slots_.pop_back();
  return slot;
}

std::uint32_t ViewIndex::TakeChunk(std::uint32_t next) {
  Chunk fresh{};
  fresh.entries.fill(kNoEntry);
  fresh.next = next;
  if (free_chunks_.empty()) {
    free_chunks_.push_back(chunk_count_++);
    if (blocks_.size() * kChunksABlock < chunk_count_) {
      blocks_.push_back(std::make_unique<Block>());
    }
  }
  const std::uint32_t chunk = free_chunks_.back();
  free_chunks_.pop_back();
  ChunkAt(chunk) = fresh;
  return chunk;
}

void ViewIndex::Insert(std::uint32_t word, std::uint32_t entry) {
  std::uint32_t& head = heads_[word];
  if (head == 0 || ChunkAt(head).entries.back() != kNoEntry) head = TakeChunk(head);
  auto& entries = ChunkAt(head).entries;
  *std::find(entries.begin(), entries.end(), kNoEntry) = entry;
}

bool ViewIndex::Add(const route::RouteKey& key, const route::Segment& segment) {
  if (Holds({key, segment.index})) return true;
  const std::optional<std::uint32_t> slot = TakeSlot();
  if (!slot) return false;
  Route& route = RouteOf(key);
  auto& held = route.segments;
  const std::uint32_t number = segment.index.value();
  held.insert(std::upper_bound(held.begin(), held.end(), number), number);
  const std::vector<route::Descriptor> descriptors = DescriptorsOf(segment);
  slots_[*slot] = {route.number, number, static_cast<std::uint32_t>(descriptors.size())};
  entries_.clear();
  for (const route::Descriptor& descriptor : descriptors) {
    const auto where = WhereIs(descriptor);
    for (std::uint32_t table = 0; table < kTables; ++table) {
      entries_.emplace_back(table * kWords + where[table].word,
                            *slot << kCheckBits | where[table].check);
    }
  }
  InsertAll();
  return true;
}

// The tables are larger than the caches, and words lie anywhere in them, so all of them are
// prefetched at once.
void ViewIndex::InsertAll() {
  for (const auto& [word, entry] : entries_) __builtin_prefetch(&heads_[word], 1);
  for (const auto& [word, entry] : entries_) {
    if (heads_[word] != 0) __builtin_prefetch(&ChunkAt(heads_[word]), 1);
  }
  for (const auto& [word, entry] : entries_) Insert(word, entry);
}

void ViewIndex::Remove(const route::RouteKey& key) {
  const auto known = routes_.find(key);
  if (known == routes_.end()) return;
  for (Slot& slot : slots_) {
    if (slot.route != known->second.number) continue;
    slot.route = kDead;
    ++dead_;
  }
  free_numbers_.push_back(known->second.number);
  routes_.erase(known);
  if (dead_ > std::max(kSweepFrom, slots_.size() / 4) || full()) Sweep();
}

// Removes the entries of removed segments from the tables.
void ViewIndex::Sweep() {
  for (std::uint32_t word = 0; word < heads_.size(); ++word) {
    if (heads_[word] != 0) SweepWord(word);
  }
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
    if (slots_[slot].route != kDead) continue;
    slots_[slot].route = kFree;
    free_slots_.push_back(slot);
  }
  dead_ = 0;
}

void ViewIndex::SweepWord(std::uint32_t word) {
  std::vector<std::uint32_t> alive;
  for (std::uint32_t chunk = std::exchange(heads_[word], 0); chunk != 0;
       chunk = ChunkAt(chunk).next) {
    free_chunks_.push_back(chunk);
    for (const std::uint32_t entry : ChunkAt(chunk).entries) {
      if (entry != kNoEntry && slots_[entry >> kCheckBits].route != kDead) alive.push_back(entry);
    }
  }
  for (const std::uint32_t entry : alive) Insert(word, entry);
}

// Collects in `alike_` the slots of the features that look like this one.
void ViewIndex::FindAlike(const route::Descriptor& descriptor) {
  constexpr std::size_t kAhead = 8;  // chains that are prefetched ahead of the search
  alike_.clear();
  const auto where = WhereIs(descriptor);
  const std::vector<std::uint32_t>& flips = Flips();
  std::vector<std::uint32_t>& chains = chains_;
  for (std::uint32_t table = 0; table < kTables; ++table) {
    chains.clear();
    for (const std::uint32_t flip : flips) {
      const std::uint32_t head = heads_[table * kWords + (where[table].word ^ flip)];
      if (head != 0) chains.push_back(head);
    }
    for (std::size_t i = 0; i < chains.size(); ++i) {
      if (i + kAhead < chains.size()) __builtin_prefetch(&ChunkAt(chains[i + kAhead]));
      FindAlike(chains[i], where[table].check);
    }
  }
}

void ViewIndex::FindAlike(std::uint32_t chunk, std::uint32_t check) {
  const auto& few = FewFlips();
  for (int looked_at = 0; chunk != 0 && looked_at < kMostChunks; ++looked_at) {
    for (const std::uint32_t entry : ChunkAt(chunk).entries) {
      if (entry == kNoEntry) break;
      if (few[(entry ^ check) & kCheckMask]) alike_.push_back(entry >> kCheckBits);
    }
    chunk = ChunkAt(chunk).next;
  }
}

// Gives each segment with such a feature a vote, which is greater the fewer such features there
// are.
void ViewIndex::Vote(std::uint16_t number, std::size_t octave) {
  constexpr double kFine = 64.0;
  constexpr std::size_t kAFew = 1000;  // with fewer segments than this, all features count
  const double rare =
      static_cast<double>(std::max(size(), kAFew)) / static_cast<double>(alike_.size() + 1);
  if (rare <= 1.0) return;
  const auto vote = static_cast<std::uint16_t>(kFine * std::log(rare));
  for (const std::uint32_t slot : alike_) {
    Tally& tally = tallies_[slot];
    if (tally.voter == number) continue;
    tally.voter = number;
    std::uint16_t& votes = tally.votes[octave];
    votes = static_cast<std::uint16_t>(std::min(votes + vote, kMostVotes));
  }
}

// Returns the most votes of features that differ in size as those of one key view do: by two
// octaves.
int ViewIndex::Votes(const Tally& tally) {
  int most = 0;
  for (std::size_t octave = 1; octave < kOctaves; ++octave) {
    most = std::max(most, tally.votes[octave - 1] + tally.votes[octave]);
  }
  return most;
}

std::vector<ViewIndex::Place> ViewIndex::Candidates(std::span<const route::ViewFeature> view,
                                                    std::size_t most) {
  std::fill(tallies_.begin(), tallies_.end(), Tally{});
  const float least_px = LeastSize_px(view);
  std::uint16_t number = 0;
  const bool sized = !view.empty() && view.front().size_px > 0.0F;
  const std::size_t voters = sized ? kMostVotersOfAllSizes : kMostVoters;
  for (const route::ViewFeature& feature : view.first(std::min(view.size(), voters))) {
    if (!route::IsDescribed(feature.descriptor)) continue;
    FindAlike(feature.descriptor);
    Vote(++number, OctaveOf(feature.size_px / least_px, kOctaves));
  }
  // Votes by chance grow with the number of features.
  std::vector<std::pair<float, std::uint32_t>> voted;
  for (std::uint32_t slot = 0; slot < slots_.size(); ++slot) {
    if (tallies_[slot].voter == 0 || slots_[slot].route >= kFree) continue;
    const auto features = static_cast<float>(slots_[slot].features + kUsualFeatures);
    voted.emplace_back(-static_cast<float>(Votes(tallies_[slot])) / std::sqrt(features), slot);
  }
  const auto count = static_cast<std::ptrdiff_t>(std::min(most, voted.size()));
  std::partial_sort(voted.begin(), voted.begin() + count, voted.end());
  voted.resize(static_cast<std::size_t>(count));
  std::vector<Place> places;
  places.reserve(voted.size());
  for (const auto& [rank, slot] : voted) {
    places.push_back({*keys_[slots_[slot].route], SegmentIndex(slots_[slot].segment)});
  }
  return places;
}

bool ViewIndex::Holds(const Place& place) const {
  const auto known = routes_.find(place.key);
  if (known == routes_.end()) return false;
  const auto& held = known->second.segments;
  return std::binary_search(held.begin(), held.end(), place.segment.value());
}

std::vector<ViewIndex::Place> ViewIndex::Around(const Place& place,
                                                std::size_t before_and_after) const {
  std::vector<Place> around;
  const auto known = routes_.find(place.key);
  if (known == routes_.end()) return around;
  const auto& held = known->second.segments;
  const auto at = std::lower_bound(held.begin(), held.end(), place.segment.value());
  const auto reach = static_cast<std::ptrdiff_t>(before_and_after);
  const auto from = at - std::min(reach, at - held.begin());
  const auto until = at + std::min(reach + 1, held.end() - at);
  for (auto segment = from; segment != until; ++segment) {
    if (segment != at) around.push_back({place.key, SegmentIndex(*segment)});
  }
  return around;
}

std::size_t ViewIndex::bytes() const {
  return heads_.size() * sizeof(heads_[0]) + chunk_count_ * sizeof(Chunk) +
         slots_.capacity() * sizeof(Slot) + tallies_.capacity() * sizeof(Tally) +
         size() * sizeof(std::uint32_t) + routes_.size() * kBytesARoute;
}

}  // namespace trailcast::view
