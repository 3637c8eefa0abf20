#include "tests/soak/ledger.h"

#include <fmt/format.h>

#include <utility>

namespace trailcast::soak {

void Ledger::NoteSegment(const route::RouteKey& key, SegmentIndex index) {
  if (durable_[key].insert(index).second) ++receipted_;
}

void Ledger::Note(const exchange::Receipt& receipt) {
  if (forgotten_.contains(receipt.key)) return;
  for (std::uint32_t i = 0; i < receipt.durable_prefix; ++i) {
    NoteSegment(receipt.key, SegmentIndex(i));
  }
  for (const auto& segment : receipt.durable_beyond) NoteSegment(receipt.key, segment.index);
}

void Ledger::NoteTaught(const route::RouteKey& key, std::vector<route::SegmentPiece> pieces) {
  taught_.insert_or_assign(key, std::move(pieces));
}

void Ledger::Forget(const route::RouteKey& key) {
  forgotten_.insert(key);
  durable_.erase(key);
  taught_.erase(key);
}

std::vector<std::string> Ledger::LostIn(store::RouteStore& store) {
  std::vector<std::string> lost;
  for (const auto& [key, indices] : durable_) {
    const auto taught = taught_.find(key);
    for (const SegmentIndex index : indices) {
      ++checked_;
      const auto held = store.ReadSegment(key, index);
      if (!held) {
        lost.push_back(held.error().message);
      } else if (taught != taught_.end() && *held != taught->second.at(index.value())) {
        lost.push_back(fmt::format("segment {} of route {} is not the one that was taught",
                                   index.value(), key.route.value()));
      }
    }
  }
  return lost;
}

std::vector<std::string> Ledger::UndeletedIn(store::RouteStore& store) const {
  std::vector<std::string> left;
  for (const route::RouteKey& key : deleted_) {
    const auto held = store.HeldSegments(key);
    if (!held) {
      left.push_back(held.error().message);
    } else if (!held->empty()) {
      left.push_back(fmt::format("{} segments of route {}", held->size(), key.route.value()));
    }
  }
  return left;
}

}  // namespace trailcast::soak
