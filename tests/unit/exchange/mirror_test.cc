#include "services/exchange/mirror.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "services/catalog/editing.h"
#include "services/exchange/in_process_exchange.h"
#include "services/exchange/publish.h"
#include "services/exchange/route_keeper.h"
#include "services/route/labels.h"
#include "tests/support/faulty_exchange.h"
#include "tests/support/memory_store.h"

namespace trailcast::exchange {
namespace {

using namespace std::chrono_literals;
using route::EditAction;
using route::RouteInfo;
using route::RouteKey;
using route::RouteState;
using route::Standing;
using test::KeyNumber;
using Time = Mirror::Time;

// One server with a store of its own, stepped by hand. Its store outlives its ends.
class Site {
 public:
  Site(InProcessBus& bus, std::string name, std::uint32_t seed)
      : bus_(bus), name_(std::move(name)), seed_(seed) {
    Start();
  }

  void Start() {
    exchange_ = std::make_unique<FaultyExchange>(bus_.Open(ServerTopics()), Faults{}, seed_++);
    RouteKeeper::Catalog catalog;
    catalog.answer = [](const CatalogRequest&) { return CatalogReply(); };
    catalog.plan = [this](const route::RouteEdit& edit) { return catalog::PlanEdit(edit, store_); };
    keeper_ = RouteKeeper::Open(name_, store_, std::move(catalog), test::ToyIntegrity(),
                                {.announced_at_start = announced_at_start})
                  .value();
    mirror_.emplace(name_, store_);
  }
  void Kill() {
    mirror_.reset();
    keeper_.reset();
    exchange_.reset();
  }
  [[nodiscard]] bool runs() const { return keeper_ != nullptr; }

  void Handle(const Message& message, Time now) {
    mirror_->Handle(message, now);
    keeper_->Handle(message, now);
  }

  void Step(Time now) {
    if (!runs()) return;
    for (const Message& message : exchange_->Take(0ms)) Handle(message, now);
    std::vector<Message> out = keeper_->Tick(now);
    for (const Message& message : out) {
      if (const auto* announced = std::get_if<RouteAnnouncement>(&message)) {
        mirror_->NoteStored(announced->info.key);
      } else if (const auto* receipt = std::get_if<Receipt>(&message)) {
        Note(*receipt);
      }
    }
    for (Message& told : mirror_->Tick(now)) out.push_back(std::move(told));
    if (now >= status_due_) {
      status_due_ = now + 1s;
      out.emplace_back(AgentStatus{.agent = name_, .role = AgentRole::kServer});
    }
    for (const Message& message : out) {
      const auto* batch = std::get_if<SegmentBatch>(&message);
      if (batch != nullptr) most_sent_ = std::max(most_sent_, sent_ += batch->pieces.size());
    }
    sent_ = 0;
    (void)PublishAll(*exchange_, out, [&](const Message& message, bool sent) {
      sent ? keeper_->Sent(message) : keeper_->NotSent(message, now);
    });
  }

  [[nodiscard]] std::vector<RouteInfo> Infos() { return store_.FindRoutesWithin("").value(); }
  [[nodiscard]] std::vector<RouteInfo> Living() { return store_.ListRoutes().value(); }

  InProcessBus& bus_;
  AgentId name_;
  std::uint32_t seed_;
  std::uint32_t announced_at_start = 256;
  test::MemoryStore store_;
  std::unique_ptr<FaultyExchange> exchange_;
  std::unique_ptr<RouteKeeper> keeper_;
  std::optional<Mirror> mirror_;
  Time status_due_{};
  std::size_t sent_ = 0;
  std::size_t most_sent_ = 0;
  // Its scouts have acknowledgements of so many segments from the first on.
  std::map<RouteKey, std::uint32_t> receipted_;

 private:
  // This counts as far as the route was announced, because no other server can know that there is
  // more.
  void Note(const Receipt& receipt) {
    const auto info = store_.FindRoute(receipt.key).value();
    if (!info) return;
    std::uint32_t& prefix = receipted_[receipt.key];
    prefix = std::max(prefix, std::min(receipt.durable_prefix, info->segment_count));
  }
};

// Two sites and the line between them.
class MirrorTest : public testing::Test {
 protected:
  struct Taught {
    RouteInfo info;
    std::vector<route::SegmentPiece> pieces;
  };

  void Step() {
    now_ += 10ms;
    for (Site* site : {&a_, &b_}) site->Step(now_);
    const bool gone = cut_at_ && now_ >= *cut_at_ + 3s;
    if (gone) {
      for (Site* site : {&a_, &b_}) TellGone(*site);
      cut_at_.reset();
    }
  }
  void StepFor(std::chrono::milliseconds duration) {
    for (const auto end = now_ + duration; now_ < end;) Step();
  }
  template <typename Done>
  [[nodiscard]] bool StepUntil(const Done& done, std::chrono::seconds limit = 600s) {
    for (const auto end = now_ + limit; now_ < end && !done();) Step();
    return done();
  }
  void Cut(bool cut) {
    cut_ = cut;
    if (cut && !cut_at_) cut_at_ = now_;
    if (!cut) cut_at_.reset();
    for (Site* site : {&a_, &b_}) {
      if (site->runs()) site->exchange_->set_cut_off(cut);
    }
  }
  void TellGone(Site& site) {
    const AgentId other = &site == &a_ ? b_.name_ : a_.name_;
    if (site.runs()) site.Handle(AgentGone{.agent = other}, now_);
  }
  void Restart(Site& site) {
    site.Kill();
    Site& other = &site == &a_ ? b_ : a_;
    if (other.runs()) other.Handle(AgentGone{.agent = site.name_}, now_);
    site.Start();
    site.exchange_->set_cut_off(cut_);
  }

  // Teaches as a scout of this name; nobody has it yet.
  Taught& Teach(unsigned route, std::uint64_t teaching, std::uint32_t revision,
                std::uint32_t segments) {
    const RouteKey key = KeyNumber(route, teaching);
    auto& taught = taught_[key];
    // By their bytes, no two teachings share a segment.
    for (std::uint32_t i = 0; i < segments; ++i) {
      taught.pieces.push_back(
          test::PieceOf(key, i, 40 + key.teaching.value() % 50, static_cast<std::uint8_t>(route)));
    }
    taught.info = test::InfoOf(key, taught.pieces, RouteState::kComplete);
    taught.info.name = fmt::format("route-{}", route);
    taught.info.revision = RevisionNumber(revision);
    taught.info.taught_unix_ms += ++clock_;
    return taught;
  }
  // Segments that come to a site, and what its scout says of the route then.
  void Deliver(Site& site, const Taught& taught, std::uint32_t first, std::uint32_t end,
               bool complete) {
    if (!site.runs()) return;
    RouteInfo info = taught.info;
    if (!complete) {
      info = test::InfoOf(info.key, std::span(taught.pieces).first(end), RouteState::kTeaching);
      info.name = taught.info.name;
      info.revision = taught.info.revision;
      info.taught_unix_ms = taught.info.taught_unix_ms;
    }
    SegmentBatch batch{.sender = info.scout, .pieces = {}};
    for (std::uint32_t i = first; i < end; ++i) batch.pieces.push_back(taught.pieces[i]);
    site.Handle(RouteAnnouncement{.holder = info.scout, .info = info}, now_);
    site.Handle(batch, now_);
  }
  void DeliverAll(Site& site, const Taught& taught) {
    Deliver(site, taught, 0, static_cast<std::uint32_t>(taught.pieces.size()), true);
  }
  void Edit(Site& site, route::RouteEdit edit) {
    if (!site.runs()) return;
    RouteEditRequest request{.client = AgentId("desk"), .request = ++requests_};
    request.edit = std::move(edit);
    site.Handle(request, now_);
  }

  static std::map<RouteKey, std::uint64_t> Digests(Site& site) {
    std::map<RouteKey, std::uint64_t> digests;
    for (const RouteInfo& info : site.Infos()) digests.emplace(info.key, MirrorDigest(info));
    std::erase_if(digests, [](const auto& each) { return each.second == 0; });
    return digests;
  }
  [[nodiscard]] bool HoldTheSame() { return Digests(a_) == Digests(b_); }
  [[nodiscard]] std::string Differences() {
    std::string text;
    for (Site* site : {&a_, &b_}) {
      Site& other = site == &a_ ? b_ : a_;
      for (const RouteInfo& info : site->Infos()) {
        const auto theirs = other.store_.FindRoute(info.key).value();
        if (theirs && MirrorDigest(*theirs) == MirrorDigest(info)) continue;
        text += fmt::format("{}: {} '{}' revision {} edition {} {}, {} segments {}, {} held\n",
                            site->name_.value(), Describe(info.key), info.name, RevisionText(info),
                            info.edition, NameOf(info.standing), info.segment_count,
                            StateText(info), site->store_.HeldSegments(info.key)->size());
      }
    }
    return text;
  }
  [[nodiscard]] bool InStep() {
    const auto knows = [](Site& site) {
      const auto& others = site.mirror_->others();
      return others.size() == 1 && others.begin()->second.there &&
             !others.begin()->second.differs_since;
    };
    return knows(a_) && knows(b_);
  }
  void ExpectEachRouteIsOne() {
    for (Site* site : {&a_, &b_}) {
      std::set<std::pair<RouteId, RevisionNumber>> numbers;
      std::set<RouteId> active;
      for (const RouteInfo& info : site->Living()) {
        EXPECT_TRUE(numbers.emplace(info.key.route, info.revision).second)
            << Describe(info) << " is twice at " << site->name_.value();
        if (info.standing != Standing::kActive) continue;
        EXPECT_TRUE(active.insert(info.key.route).second)
            << Describe(info) << " is not the only active one at " << site->name_.value();
      }
    }
  }
  // At both sites, whichever has said so.
  void ExpectReceiptedIsHeld() {
    for (Site* site : {&a_, &b_}) {
      for (const auto& [key, prefix] : site->receipted_) {
        for (Site* holder : {&a_, &b_}) {
          const auto info = holder->store_.FindRoute(key).value();
          if (info && info->standing == Standing::kDeleted) continue;
          for (std::uint32_t i = 0; i < prefix; ++i) {
            const auto piece = holder->store_.ReadSegment(key, SegmentIndex(i));
            ASSERT_TRUE(piece) << Describe(key) << " segment " << i << " at "
                               << holder->name_.value();
            EXPECT_EQ(*piece, taught_.at(key).pieces[i]);
          }
        }
      }
    }
  }

  InProcessBus bus_;
  Site a_{bus_, "site-a", 1};
  Site b_{bus_, "site-b", 1001};
  Time now_{};
  bool cut_ = false;
  std::optional<Time> cut_at_;
  std::map<RouteKey, Taught> taught_;
  std::int64_t clock_ = 0;
  std::uint64_t requests_ = 0;
};

TEST_F(MirrorTest, WhatOneSiteHadBeforeTheyMetComesToTheOther) {
  Cut(true);
  DeliverAll(a_, Teach(1, 11, 1, 5));
  DeliverAll(b_, Teach(2, 22, 1, 7));
  StepFor(5s);
  Cut(false);
  ASSERT_TRUE(StepUntil([&] { return HoldTheSame() && InStep(); }, 60s));
  EXPECT_EQ(a_.Living().size(), 2U);
  ExpectReceiptedIsHeld();
}

// More than a server announces by itself, and more than are asked for at a time.
TEST_F(MirrorTest, AnEmptySiteIsFilledWithAllThatTheOtherHas) {
  Cut(true);
  for (unsigned route = 0; route < 400; ++route) DeliverAll(a_, Teach(route * 7919, 1, 1, 3));
  StepFor(5s);
  a_.announced_at_start = 4;
  Restart(a_);
  Cut(false);
  std::size_t most = 0;
  ASSERT_TRUE(StepUntil([&] {
    most = std::max(most, b_.mirror_->under_way());
    return HoldTheSame() && InStep();
  }));
  EXPECT_EQ(b_.Living().size(), 400U);
  EXPECT_LE(most, MirrorOptions().under_way);
  ExpectReceiptedIsHeld();
}

TEST_F(MirrorTest, AFullSiteIsFilledWhenThereIsRoomAgain) {
  DeliverAll(a_, Teach(1, 11, 1, 5));
  b_.store_.full = true;
  StepFor(60s);
  EXPECT_FALSE(InStep());
  b_.store_.full = false;
  EXPECT_TRUE(StepUntil([&] { return HoldTheSame() && InStep(); }, 1500s));
}

TEST_F(MirrorTest, WhatWasDeletedBehindACutStaysDeletedAlsoAfterARestart) {
  DeliverAll(a_, Teach(1, 11, 1, 5));
  ASSERT_TRUE(StepUntil([&] { return b_.Living().size() == 1 && HoldTheSame(); }));
  Cut(true);
  Edit(a_, {.action = EditAction::kRetire, .route = "route-1"});
  Edit(a_, {.action = EditAction::kDelete, .route = "route-1"});
  for (int i = 0; i < 5; ++i)
    Edit(b_, {.action = EditAction::kDescribe,
              .route = "route-1",
              .text = fmt::format("renewed {}", i)});
  StepFor(5s);
  Restart(a_);
  Restart(b_);
  Cut(false);
  ASSERT_TRUE(StepUntil([&] { return b_.Living().empty() && InStep(); }, 60s));
  StepFor(30s);
  EXPECT_TRUE(a_.Living().empty()) << "and does not come back";
}

TEST_F(MirrorTest, WhatWasRetiredBehindACutIsRetiredAtBoth) {
  DeliverAll(a_, Teach(1, 11, 1, 5));
  ASSERT_TRUE(StepUntil([&] { return b_.Living().size() == 1 && HoldTheSame(); }));
  Cut(true);
  Edit(b_, {.action = EditAction::kRetire, .route = "route-1"});
  StepFor(1s);
  Restart(b_);
  Cut(false);
  ASSERT_TRUE(StepUntil([&] { return HoldTheSame() && InStep(); }, 60s));
  EXPECT_EQ(a_.Living().at(0).standing, Standing::kRetired);
}

TEST_F(MirrorTest, OfTwoActivatedMeanwhileOneCountsAndNumbersStayApart) {
  DeliverAll(a_, Teach(1, 11, 1, 5));
  ASSERT_TRUE(StepUntil([&] { return b_.Living().size() == 1 && HoldTheSame(); }));
  Cut(true);
  const RouteKey first = Teach(1, 99, 2, 4).info.key;  // taught first, by its teaching the greater
  const RouteKey second = Teach(1, 22, 2, 6).info.key;
  DeliverAll(a_, taught_.at(second));
  DeliverAll(b_, taught_.at(first));
  StepFor(1s);
  Edit(a_, {.action = EditAction::kActivate, .route = "route-1", .revision = 2});
  StepFor(1s);
  Cut(false);
  ASSERT_TRUE(StepUntil([&] { return HoldTheSame() && InStep(); }, 60s));
  ExpectEachRouteIsOne();
  EXPECT_EQ(a_.store_.FindRoute(first).value()->revision, RevisionNumber(2));
  EXPECT_EQ(a_.store_.FindRoute(second).value()->revision, RevisionNumber(3));
  EXPECT_EQ(a_.store_.FindRoute(second).value()->standing, Standing::kActive);
}

TEST_F(MirrorTest, ALaterActivationCountsThoughTheLineIsCutInTheMiddleOfIt) {
  DeliverAll(a_, Teach(1, 11, 1, 2));
  DeliverAll(a_, Teach(1, 22, 2, 2));
  ASSERT_TRUE(StepUntil([&] { return b_.Living().size() == 2 && HoldTheSame(); }));
  for (int i = 0; i < 5; ++i)
    Edit(a_, {.action = EditAction::kDescribe,
              .route = "route-1",
              .revision = 1,
              .text = fmt::format("renewed {}", i)});
  ASSERT_TRUE(StepUntil([&] { return HoldTheSame(); }));
  Cut(true);
  Edit(a_, {.action = EditAction::kActivate, .route = "route-1", .revision = 2});
  StepFor(100ms);
  // It changed two revisions, and the news of one arrives.
  const RouteInfo activated = *a_.store_.FindRoute(KeyNumber(1, 22)).value();
  ASSERT_EQ(activated.standing, Standing::kActive);
  b_.Handle(RouteAnnouncement{.holder = a_.name_, .info = activated}, now_);
  StepFor(5s);
  ExpectEachRouteIsOne();
  EXPECT_EQ(b_.store_.FindRoute(activated.key).value()->standing, Standing::kActive);
  Cut(false);
  ASSERT_TRUE(StepUntil([&] { return HoldTheSame() && InStep(); }, 60s));
  EXPECT_EQ(a_.store_.FindRoute(activated.key).value()->standing, Standing::kActive);
}

TEST_F(MirrorTest, APartThatTheOtherHasLongerGoesOnWhereItBrokeOff) {
  const Taught& taught = Teach(1, 11, 1, 40);
  Deliver(a_, taught, 0, 30, false);
  ASSERT_TRUE(StepUntil([&] { return b_.store_.HeldSegments(taught.info.key)->size() > 4; }));
  Cut(true);
  StepFor(5s);
  const std::size_t held = b_.store_.HeldSegments(taught.info.key)->size();
  Deliver(a_, taught, 30, 40, true);
  StepFor(5s);
  Cut(false);
  const auto before = a_.keeper_->counters().answered;
  ASSERT_TRUE(StepUntil([&] { return HoldTheSame() && InStep(); }, 60s));
  EXPECT_LE(a_.keeper_->counters().answered - before, 40 - held + 8);
  ExpectReceiptedIsHeld();
}

// Whatever scouts deliver to either, operators change at either, and whatever breaks.
class MirrorModelTest : public MirrorTest, public testing::WithParamInterface<std::uint32_t> {
 protected:
  [[nodiscard]] unsigned Draw(unsigned below) {
    return std::uniform_int_distribution<unsigned>(0, below - 1)(random_);
  }
  Site& AnySite() { return Draw(2) == 0 ? a_ : b_; }

  void TeachSome() {
    const unsigned route = Draw(4);
    const auto count = 1 + Draw(12);
    Taught& taught = Teach(route, ++teachings_ * 7 % 1009, 1 + Draw(3), count);
    Site& site = AnySite();
    const auto break_off = Draw(count + 1);
    Deliver(site, taught, 0, break_off, false);
    StepFor(std::chrono::milliseconds(10 * Draw(50)));
    // The rest here, at the other site, or never.
    if (Draw(4) == 0) return;
    Deliver(Draw(3) == 0 ? AnySite() : site, taught, break_off, count, true);
  }
  void EditSome() {
    static constexpr EditAction kActions[] = {
        EditAction::kActivate, EditAction::kActivate, EditAction::kRollBack, EditAction::kRetire,
        EditAction::kDelete,   EditAction::kTag,      EditAction::kDescribe, EditAction::kRename};
    route::RouteEdit edit{.action = kActions[Draw(std::size(kActions))]};
    const RouteId route = KeyNumber(Draw(4)).route;
    edit.route = route.value();
    if (Draw(2) == 0) edit.revision = 1 + Draw(4);
    if (edit.action == EditAction::kDelete && Draw(3) != 0) return;
    if (edit.action == EditAction::kTag) edit.tags = {fmt::format("tag-{}", Draw(5))};
    if (edit.action == EditAction::kDescribe) edit.text = fmt::format("text {}", Draw(100));
    if (edit.action == EditAction::kRename) {
      edit.revision = 0;
      edit.text = fmt::format("name-{}-{}", route.value().back(), Draw(100));
    }
    Edit(AnySite(), std::move(edit));
  }
  void BreakSome() {
    switch (Draw(5)) {
      case 0:
        Restart(AnySite());
        break;
      case 1: {
        const Faults bad{.drop = 0.3, .duplicate = 0.2, .delay = 0.3, .corrupt = 0.1};
        AnySite().exchange_->set_faults(Draw(2) == 0 ? bad : Faults{});
        break;
      }
      case 2: {
        Site& site = AnySite();
        site.store_.full = !site.store_.full;
        break;
      }
      default:
        Cut(!cut_);
    }
  }

  std::mt19937 random_{GetParam()};
  std::uint64_t teachings_ = 0;
};

TEST_P(MirrorModelTest, ConvergesAndLosesNothingReceiptedWhateverBreaks) {
  for (int i = 0; i < 120; ++i) {
    const unsigned what = Draw(8);
    what < 3 ? TeachSome() : what < 6 ? EditSome() : BreakSome();
    StepFor(std::chrono::milliseconds(10 * Draw(300)));
  }
  Cut(false);
  for (Site* site : {&a_, &b_}) {
    site->exchange_->set_faults({});
    site->store_.full = false;
  }
  EXPECT_TRUE(StepUntil([&] { return HoldTheSame() && InStep(); }, 3000s)) << Differences();
  ExpectEachRouteIsOne();
  ExpectReceiptedIsHeld();
  StepFor(30s);
  EXPECT_TRUE(HoldTheSame());
  EXPECT_TRUE(InStep());
}

INSTANTIATE_TEST_SUITE_P(Seeds, MirrorModelTest, testing::Range(1U, 9U));

}  // namespace
}  // namespace trailcast::exchange
