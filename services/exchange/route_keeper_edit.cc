// RouteKeeper's dealings with operators: edits of what it keeps.
#include <algorithm>

#include "services/exchange/bounds.h"
#include "services/exchange/route_keeper.h"
#include "services/exchange/text.h"

namespace trailcast::exchange {
namespace {

using route::RouteInfo;

// An operator who heard no answer asks again; carried out twice, some edits would do something
// else.
constexpr std::size_t kRemembered = 64;

}  // namespace

void RouteKeeper::HandleEdit(const RouteEditRequest& request, Time now) {
  const auto said = std::find_if(edited_.begin(), edited_.end(), [&](const CatalogReply& reply) {
    return reply.client == request.client && reply.request == request.request;
  });
  if (said != edited_.end()) {
    replies_.emplace_back(*said);
    return;
  }
  CatalogReply reply{.server = self_, .client = request.client, .request = request.request};
  if (auto edited = Edit(request.edit, now)) {
    AddNote(Note::Severity::kInfo,
            fmt::format("edit/{}/{}", request.client.value(), request.request),
            fmt::format("'{}' changes {} revisions of route '{}'", request.client.value(),
                        edited->size(), request.edit.route),
            now);
    reply.page.total = edited->size();
    edited->resize(std::min(edited->size(), kMaxRoutesPerReply));
    reply.page.routes = std::move(*edited);
  } else {
    reply.error = PlainText(edited.error().message, kMaxLineBytes);
  }
  edited_.push_back(reply);
  if (edited_.size() > kRemembered) edited_.pop_front();
  replies_.emplace_back(std::move(reply));
}

Result<std::vector<RouteInfo>> RouteKeeper::Edit(const route::RouteEdit& edit, Time now) {
  auto changed = catalog_.plan(edit);
  if (!changed) return changed;
  if (auto done = Relabel(*changed, now); !done) return tl::unexpected(done.error());
  return changed;
}

Result<void> RouteKeeper::Relabel(std::span<const RouteInfo> infos, Time now) {
  if (auto stored = store_.PutRoutes(infos); !stored) return stored;
  for (const RouteInfo& info : infos) {
    KeptRoute* kept = Find(info.key, now);
    if (kept == nullptr) continue;  // the store has it; it is announced when somebody asks
    kept->MarkStored(info);
    kept->announce_due = kept->resend_due = true;
    kept->announced_at.reset();  // not held back
    kept->receipt_at.reset();
  }
  return {};
}

}  // namespace trailcast::exchange
