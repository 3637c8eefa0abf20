#include "agent/device/src/recorded/bag_topics.h"

#include <algorithm>
#include <iterator>

#include "services/bag/ros_messages.h"

namespace trailcast::agent {
namespace {

using bag::Topic;

constexpr std::size_t kMostListed = 100;

// A kind of topic, and the flag with which a user names one.
struct Kind {
  std::vector<std::string> types;
  const char* what;
  const char* option;
};
const Kind kPictures{{bag::kImageType, bag::kCompressedImageType}, "pictures", "--image-topic"};
const Kind kCommands{{bag::kTwistType, bag::kTwistStampedType}, "commands", "--cmd-vel-topic"};
const Kind kOdometry{{bag::kOdometryType}, "odometry", "--odom-topic"};

bool IsOf(const Topic& topic, const Kind& kind) {
  return std::find(kind.types.begin(), kind.types.end(), bag::PlainType(topic.type)) !=
         kind.types.end();
}

std::string Listed(const std::vector<Topic>& topics) {
  if (topics.empty()) return "it has no topics at all";
  std::string text = "there are: ";
  for (std::size_t i = 0; i < std::min(topics.size(), kMostListed); ++i) {
    fmt::format_to(std::back_inserter(text), "{}{} ({}, {} messages)", i == 0 ? "" : ", ",
                   topics[i].name, topics[i].type, topics[i].messages);
  }
  if (topics.size() > kMostListed) text += ", ...";
  return text;
}

std::vector<Topic> Candidates(const std::vector<Topic>& topics, const Kind& kind) {
  std::vector<Topic> candidates;
  std::copy_if(topics.begin(), topics.end(), std::back_inserter(candidates),
               [&](const Topic& topic) { return topic.messages > 0 && IsOf(topic, kind); });
  return candidates;
}

Result<Topic> FindNamed(const std::vector<Topic>& topics, const Kind& kind,
                        const std::string& name) {
  const auto named = [&](const Topic& topic) {
    return topic.name == name || topic.name == "/" + name;
  };
  const auto found = std::find_if(topics.begin(), topics.end(), [&](const Topic& topic) {
    return named(topic) && IsOf(topic, kind);
  });
  if (found != topics.end()) return *found;
  const auto other = std::find_if(topics.begin(), topics.end(), named);
  if (other != topics.end()) {
    return Fail(ErrorCode::kInvalidArgument, "topic {} is a {}: {} are {}; {}", other->name,
                other->type, kind.what, fmt::join(kind.types, " or "), Listed(topics));
  }
  return Fail(ErrorCode::kNotFound, "no topic {}; {}", name, Listed(topics));
}

// Returns nothing if there is none.
Result<std::optional<Topic>> FindOnly(const std::vector<Topic>& topics, const Kind& kind) {
  const std::vector<Topic> candidates = Candidates(topics, kind);
  if (candidates.empty()) return std::nullopt;
  if (candidates.size() == 1) return candidates.front();
  return Fail(ErrorCode::kInvalidArgument, "several topics have {}: say which with {}; {}",
              kind.what, kind.option, Listed(candidates));
}

// Returns the named topic, or the only one, or nothing if there is none.
Result<std::optional<Topic>> Find(const std::vector<Topic>& topics, const Kind& kind,
                                  const std::optional<std::string>& name) {
  std::optional<Topic> found;
  if (name && !name->empty()) {
    auto named = FindNamed(topics, kind, *name);
    if (!named) return tl::unexpected(named.error());
    found = std::move(*named);
  } else {
    auto only = FindOnly(topics, kind);
    if (!only) return only;
    found = std::move(*only);
  }
  if (found && found->encoding != "cdr") {
    return Fail(ErrorCode::kInvalidArgument,
                "the messages of {} are encoded as '{}': expected 'cdr', as ROS 2 does",
                found->name, found->encoding);
  }
  return found;
}

}  // namespace

Result<BagTopics> ChooseTopics(const std::vector<Topic>& topics, const BagRun& run) {
  const auto image = Find(topics, kPictures, run.image_topic);
  if (!image) return tl::unexpected(image.error());
  if (!*image) {
    return Fail(ErrorCode::kNotFound, "no topic with pictures ({}); {}",
                fmt::join(kPictures.types, " or "), Listed(topics));
  }
  BagTopics chosen{**image, bag::PlainType((*image)->type) == bag::kCompressedImageType, {}, {}};
  // Several candidates count as none unless one is named.
  const bool named = run.command_topic && !run.command_topic->empty();
  if (run.hear_commands && (named || Candidates(topics, kCommands).size() == 1)) {
    const auto commands = Find(topics, kCommands, run.command_topic);
    if (!commands) return tl::unexpected(commands.error());
    chosen.commands = *commands;
  }
  if (run.odom_topic && run.odom_topic->empty()) return chosen;
  const auto odometry = Find(topics, kOdometry, run.odom_topic);
  if (!odometry) return tl::unexpected(odometry.error());
  chosen.odometry = *odometry;
  return chosen;
}

}  // namespace trailcast::agent
