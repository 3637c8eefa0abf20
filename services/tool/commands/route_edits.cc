#include "services/tool/commands/route_edits.h"
#include "services/fleet/operator_peer.h"

#include <fmt/ranges.h>

#include <cstdio>
#include <memory>

#include "services/base/time.h"
#include "services/exchange/bounds.h"
#include "services/fleet/routes/catalog_client.h"
#include "services/fleet/routes/transfer.h"
#include "services/route/labels.h"
#include "services/route/route_ref.h"

namespace trailcast::tool {
namespace {

using route::EditAction;
using route::RouteEdit;

void Tell(const std::vector<route::RouteInfo>& changed) {
  const route::ShortIds ids(changed);
  for (const route::RouteInfo& info : changed) {
    std::fputs(fmt::format("{} {}: {}{}{}\n", ids.Of(info), info.name, route::StateText(info),
                           info.tags.empty() ? "" : ", tags ", fmt::join(info.tags, " "))
                   .c_str(),
               stdout);
  }
  if (changed.empty()) std::fputs("nothing to change: it is so already\n", stdout);
}

// Splits a name: "hall@2" is route hall, revision 2.
Result<void> TakeApart(RouteEdit& edit) {
  const auto ref = program::WithRevision(edit.route, edit.revision);
  if (!ref) return tl::unexpected(ref.error());
  const bool of_whole_route =
      edit.action == EditAction::kRename || edit.action == EditAction::kRollBack;
  if (of_whole_route && ref->revision != 0) {
    return Fail(ErrorCode::kInvalidArgument,
                "this is about the whole route: say '{}' without '@{}'", ref->route, ref->revision);
  }
  edit.route = ref->route;
  edit.revision = ref->revision;
  return {};
}

int Run(const CLI::App& app, const program::CommonOptions& common, RouteEdit edit,
        double timeout_s) {
  auto possible = TakeApart(edit);
  if (possible) possible = exchange::CheckEdit(edit);
  if (!possible) return program::Complain(app, possible.error());
  const auto peer = fleet::JoinAsOperator(common, exchange::OperatorTopics());
  if (!peer) return program::Complain(app, peer.error());
  const auto timeout = ToMilliseconds(timeout_s);
  const auto reply = fleet::AskToEdit(*peer->exchange, peer->self, edit, timeout);
  if (!reply) return program::Complain(app, reply.error());
  Tell(reply->page.routes);
  return program::kExitOk;
}

}  // namespace

std::vector<Command> AddRouteEdits(CLI::App& routes, const program::CommonOptions& common,
                                   const double& timeout_s) {
  std::vector<Command> commands;
  const auto add = [&](const char* name, EditAction action, const char* help) {
    auto edit = std::make_shared<RouteEdit>();
    edit->action = action;
    CLI::App* app = routes.add_subcommand(name, help);
    app->fallthrough();
    app->add_option("ROUTE", edit->route,
                    "Its name, or its id, of which 7 digits or more will do; '@2' behind it is "
                    "its revision 2")
        ->required()
        ->check(program::RouteRefValidator());
    commands.push_back(
        {app, [app, edit, &common, &timeout_s] { return Run(*app, common, *edit, timeout_s); }});
    return std::pair(app, edit.get());
  };
  const auto with_revision = [](auto added, const char* help) {
    added.first->add_option("--revision", added.second->revision, help)
        ->check(program::RevisionValidator());
    return added;
  };
  with_revision(add("activate", EditAction::kActivate,
                    "Let followers take this revision from now on; takes retired ones back"),
                "Default: the newest complete one that is not retired");
  add("rollback", EditAction::kRollBack, "Activate the revision before the active one");
  const auto rename = add("rename", EditAction::kRename, "Call a route something else");
  rename.first->add_option("NAME", rename.second->text, "The new name")
      ->required()
      ->check(program::NameValidator());
  for (const auto& [name, action, help] :
       {std::tuple{"tag", EditAction::kTag, "Add tags"},
        std::tuple{"untag", EditAction::kUntag, "Take tags away"}}) {
    const auto tags = with_revision(add(name, action, help), "Default: all revisions");
    tags.first->add_option("TAG", tags.second->tags, "Words")
        ->required()
        ->check(program::NameValidator());
  }
  const auto describe = with_revision(
      add("describe", EditAction::kDescribe, "Say in a line what a route is; '' takes it away"),
      "Default: all revisions");
  describe.first->add_option("TEXT", describe.second->text, "At most 256 bytes")->required();
  with_revision(add("retire", EditAction::kRetire, "Keep it, but offer it to nobody"),
                "Default: all revisions");
  const auto remove =
      add("delete", EditAction::kDelete, "Delete it, and take it from nobody any more");
  CLI::Option* revision = remove.first->add_option("--revision", remove.second->revision,
                                                   "Of this one; not the active one");
  revision->check(program::RevisionValidator());
  const auto every = std::make_shared<bool>(false);
  CLI::Option* all = remove.first->add_flag("--all-revisions", *every, "Of all of them");
  revision->excludes(all);
  remove.first->callback([revision, all, every, edit = remove.second] {
    const bool one = revision->count() > 0 || edit->route.find('@') != std::string::npos;
    if (one == (all->count() > 0)) {
      throw CLI::RequiredError("one of ROUTE@REVISION, --revision and --all-revisions");
    }
  });
  return commands;
}

}  // namespace trailcast::tool
