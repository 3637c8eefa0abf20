// This part of NetworkRegistry handles junctions that were found.
#include <algorithm>
#include <map>
#include <utility>

#include "route_server/network/network_ids.h"
#include "route_server/network/network_registry.h"
#include "services/exchange/bounds.h"

namespace trailcast::server {
namespace {

using network::Edit;
using network::Junction;
using network::Place;
using Verdict = store::ProposedJunction::Verdict;

// An operator who names the two places need not copy the centimetres.
constexpr double kNamed_m = 1.0;

Junction JunctionOf(const Meeting& meeting) {
  Junction junction{.from = {IdOf(meeting.a), ToCentimetre(meeting.at_a_m)},
                    .to = {IdOf(meeting.b), ToCentimetre(meeting.at_b_m)},
                    .both = true};
  double turn_rad = meeting.heading_rad.value_or(0.0);
  // On a route that comes back, the end leads to the beginning.
  if (meeting.a == meeting.b && junction.from.along_m < junction.to.along_m) {
    std::swap(junction.from, junction.to);
    turn_rad = -turn_rad;
  }
  if (meeting.heading_rad) junction.lie = network::Lie{.turn_rad = turn_rad};
  return junction;
}

bool IsBeside(const Place& one, const Place& other, double length_m, double within_m) {
  return one.route == other.route && other.along_m >= one.along_m - within_m &&
         other.along_m <= one.along_m + length_m + within_m;
}

// Says whether the other junction's places are these, or further along the common section of both
// routes.
bool Covers(const Junction& junction, double length_m, const Junction& other, double within_m) {
  const auto beside = [&](const Place& from, const Place& to) {
    return IsBeside(junction.from, from, length_m, within_m) &&
           IsBeside(junction.to, to, length_m, within_m);
  };
  return beside(other.from, other.to) || beside(other.to, other.from);
}

bool AreOfOnePair(const Junction& one, const Junction& other) {
  return (one.from.route == other.from.route && one.to.route == other.to.route) ||
         (one.from.route == other.to.route && one.to.route == other.from.route);
}

std::pair<std::string, std::string> PairOf(const Junction& junction) {
  return std::minmax(junction.from.route, junction.to.route);
}

}  // namespace

Result<std::optional<NetworkRegistry::Proposed>> NetworkRegistry::Propose(
    const Meeting& meeting, double take_from, std::int64_t now_unix_ms) {
  store::ProposedJunction found{.proposal = {JunctionOf(meeting), meeting.confidence},
                                .length_m = meeting.length_m};
  const Junction& junction = found.proposal.junction;
  const bool is_joined = std::any_of(
      junctions_.begin(), junctions_.end(),
      [&](const Junction& each) { return Covers(junction, 0.0, each, kSameMeeting_m); });
  const bool is_known = std::any_of(proposed_.begin(), proposed_.end(), [&](const auto& each) {
    return Covers(junction, meeting.length_m, each.proposal.junction, kSameMeeting_m);
  });
  const auto of_pair = std::count_if(proposed_.begin(), proposed_.end(), [&](const auto& each) {
    return AreOfOnePair(junction, each.proposal.junction);
  });
  if (is_joined || is_known || of_pair >= static_cast<std::ptrdiff_t>(kMostOfAPair)) {
    return std::nullopt;
  }
  if (auto known = Know({meeting.a.route, meeting.b.route}); !known) {
    return tl::unexpected(known.error());
  }
  if (!IsUsed(junction.from) || !IsUsed(junction.to)) return std::nullopt;
  if (meeting.confidence >= take_from) found.verdict = Verdict::kTaken;
  if (auto put = store_->Put({&found, 1}, server_.value(), now_unix_ms); !put) {
    return tl::unexpected(put.error());
  }
  const bool taken = found.verdict == Verdict::kTaken;
  auto called = Called(junction);
  if (!called) return tl::unexpected(called.error());
  if (taken) {
    junctions_.push_back(junction);
    made_.push_back({now_unix_ms, server_.value(), network::ToText(*called)});
  }
  proposed_.push_back(found);
  NoteChange();
  return Proposed{network::ToText(network::Proposal{*std::move(called), meeting.confidence}),
                  taken};
}

bool NetworkRegistry::WasSearched(const route::RouteKey& key) const {
  return searched_.contains(IdOf(key));
}

void NetworkRegistry::MarkSearched(const route::RouteKey& key) {
  if (searched_.insert(IdOf(key)).second) unsaved_.push_back(IdOf(key));
}

Result<void> NetworkRegistry::SaveSearched() {
  const auto unsaved = std::exchange(unsaved_, {});
  return unsaved.empty() ? Result<void>() : store_->MarkSearched(unsaved);
}

std::size_t NetworkRegistry::open_proposals() const {
  return static_cast<std::size_t>(std::count_if(
      proposed_.begin(), proposed_.end(),
      [](const store::ProposedJunction& each) { return each.verdict == Verdict::kNone; }));
}

void NetworkRegistry::DropProposals(const route::RouteKey& key) {
  const std::string id = IdOf(key);
  const std::size_t dropped = std::erase_if(proposed_, [&](const auto& each) {
    return each.proposal.junction.from.route == id || each.proposal.junction.to.route == id;
  });
  if (searched_.erase(id) == 0 && dropped == 0) return;
  std::erase(unsaved_, id);
  NoteChange();
  // The entry that stays on the disk belongs to a revision that is gone, and is not listed.
  (void)store_->DropProposals(id);
}

std::vector<std::size_t> NetworkRegistry::Open() const {
  std::map<std::pair<std::string, std::string>, std::vector<const Junction*>> joined;
  for (const Junction& junction : junctions_) joined[PairOf(junction)].push_back(&junction);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < proposed_.size(); ++i) {
    const Junction& junction = proposed_[i].proposal.junction;
    if (proposed_[i].verdict != Verdict::kNone) continue;
    if (!IsUsed(junction.from) || !IsUsed(junction.to)) continue;
    const auto& of_pair = joined[PairOf(junction)];
    const bool is_joined = std::any_of(of_pair.begin(), of_pair.end(), [&](const Junction* each) {
      return Covers(junction, 0.0, *each, kSameMeeting_m);
    });
    if (!is_joined) open.push_back(i);
  }
  return open;
}

Result<std::vector<std::size_t>> NetworkRegistry::OpenAt(const Junction& named) const {
  Junction junction;
  auto from = Resolve(named.from);
  if (!from) return tl::unexpected(from.error());
  auto to = Resolve(named.to);
  if (!to) return tl::unexpected(to.error());
  junction.from = *std::move(from);
  junction.to = *std::move(to);
  auto open = Open();
  std::erase_if(open, [&](std::size_t each) {
    return !Covers(junction, 0.0, proposed_[each].proposal.junction, kNamed_m);
  });
  if (!open.empty()) return open;
  return Fail(
      ErrorCode::kNotFound,
      "no junction of {} and {} is proposed: 'trailcast network proposals' lists those that "
      "are",
      network::ToText(named.from), network::ToText(named.to));
}

Result<std::vector<std::string>> NetworkRegistry::Settle(const Edit& edit, const std::string& by,
                                                         std::int64_t now_unix_ms) {
  if (auto known = Know({}); !known) return tl::unexpected(known.error());
  auto open = edit.all ? Result<std::vector<std::size_t>>(Open()) : OpenAt(edit.junction);
  if (!open) return tl::unexpected(open.error());
  if (edit.all) {
    std::erase_if(*open, [&](std::size_t each) {
      const double confidence = proposed_[each].proposal.confidence;
      return confidence < edit.all->least || confidence > edit.all->most;
    });
  }
  // The remaining ones can be asked for again.
  open->resize(std::min(open->size(), exchange::kMaxNetworkLines));
  const bool taken = edit.kind == Edit::Kind::kConfirm;
  std::vector<std::string> lines;
  std::vector<store::ProposedJunction> settled;
  for (const std::size_t each : *open) {
    settled.push_back(proposed_[each]);
    settled.back().verdict = taken ? Verdict::kTaken : Verdict::kRefused;
    const network::Proposal& proposal = settled.back().proposal;
    auto called = Called(proposal.junction);
    if (!called) return tl::unexpected(called.error());
    lines.push_back(taken ? network::ToText(*called)
                          : network::ToText(network::Proposal{*called, proposal.confidence}));
  }
  if (auto put = store_->Put(settled, by, now_unix_ms); !put) return tl::unexpected(put.error());
  for (std::size_t i = 0; i < settled.size(); ++i) {
    proposed_[(*open)[i]] = settled[i];
    if (taken) junctions_.push_back(settled[i].proposal.junction);
  }
  NoteChange();
  return lines;
}

}  // namespace trailcast::server
