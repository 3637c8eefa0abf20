#include "services/store/damaged_store.h"

#include <unistd.h>

#include "services/store/salvage.h"

namespace trailcast::store {
namespace {

using route::RouteInfo;
using route::RouteKey;

// A store's file that its owner deletes.
class ScratchFile {
 public:
  explicit ScratchFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~ScratchFile() {
    std::error_code ignored;
    for (const char* part : {"", "-wal"}) std::filesystem::remove(path_.string() + part, ignored);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

class ReadOnlyStore final : public RouteStore {
 public:
  ReadOnlyStore(std::unique_ptr<ScratchFile> file, std::unique_ptr<RouteStore> store,
                std::string reason)
      : file_(std::move(file)), store_(std::move(store)), reason_(std::move(reason)) {}

  Result<void> PutRoutes(std::span<const RouteInfo>) override { return Refuse(); }
  Result<void> AppendSegments(std::span<const route::SegmentPiece>) override { return Refuse(); }
  Result<void> DropSegments(const RouteKey&) override { return Refuse(); }
  Result<void> MarkReceipted(const RouteKey&, std::span<const SegmentIndex>) override {
    return Refuse();
  }

  Result<route::SegmentPiece> ReadSegment(const RouteKey& key, SegmentIndex index) override {
    return store_->ReadSegment(key, index);
  }
  Result<std::vector<SegmentIndex>> HeldSegments(const RouteKey& key) override {
    return store_->HeldSegments(key);
  }
  Result<std::vector<HeldSegment>> SegmentDigests(const RouteKey& key) override {
    return store_->SegmentDigests(key);
  }
  Result<std::vector<HeldTeaching>> ListHeld(const RouteKey& after, std::size_t most) override {
    return store_->ListHeld(after, most);
  }
  Result<std::optional<route::Bytes>> FindContent(const route::Digest& digest) override {
    return store_->FindContent(digest);
  }
  Result<std::optional<RouteInfo>> FindRoute(const RouteKey& key) override {
    return store_->FindRoute(key);
  }
  Result<std::vector<RouteInfo>> FindRevisions(const RouteId& route) override {
    return store_->FindRevisions(route);
  }
  Result<std::vector<RouteInfo>> FindRoutesWithin(const std::string& id_prefix) override {
    return store_->FindRoutesWithin(id_prefix);
  }
  Result<std::vector<KnownTeaching>> FindTeachings(const RouteId& route) override {
    return store_->FindTeachings(route);
  }
  Result<std::vector<RouteInfo>> ListRoutes() override { return store_->ListRoutes(); }
  Result<std::vector<RouteInfo>> FindRoutesByName(const std::string& name) override {
    return store_->FindRoutesByName(name);
  }
  Result<route::RoutePage> QueryRoutes(const route::RouteQuery& query) override {
    return store_->QueryRoutes(query);
  }
  Result<std::vector<std::string>> NamesNear(const std::string& name, std::size_t count) override {
    return store_->NamesNear(name, count);
  }
  Result<std::vector<SegmentIndex>> UnreceiptedSegments(const RouteKey& key) override {
    return store_->UnreceiptedSegments(key);
  }
  Result<std::vector<std::string>> Verify() override { return store_->Verify(); }

 private:
  [[nodiscard]] tl::unexpected<Error> Refuse() const {
    return tl::unexpected(Error{ErrorCode::kUnavailable, reason_});
  }

  std::unique_ptr<ScratchFile> file_;  // must outlive store_
  std::unique_ptr<RouteStore> store_;
  std::string reason_;
};

}  // namespace

Result<DamagedStore> OpenDamagedStore(const std::filesystem::path& file) {
  auto scratch = std::make_unique<ScratchFile>(fmt::format("{}.whole-{}", file.string(), getpid()));
  auto salvaged = Salvage(file, scratch->path());
  if (!salvaged) return tl::unexpected(salvaged.error());
  auto store = OpenSqliteStore(scratch->path());
  if (!store) return tl::unexpected(store.error());
  return DamagedStore{
      std::make_unique<ReadOnlyStore>(
          std::move(scratch), std::move(*store),
          fmt::format("route store {} is damaged: it is read only until it is repaired",
                      file.filename().string())),
      std::move(salvaged->lost)};
}

}  // namespace trailcast::store
