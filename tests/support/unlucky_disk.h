#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/base/result.h"
#include "tests/support/temp_dir.h"

namespace trailcast::test {

// While this exists, it is what SQLite sees of the disk, in one thread: files as they are, and a
// copy of each as it is on the platter, which has what was synced. At one of SQLite's calls the
// power fails, or that call alone fails.
class UnluckyDisk {
 public:
  enum class Fate : std::uint8_t { kPowerGoes, kCallFails };
  // This is which of the unsynced writes have reached the platter all the same.
  enum class Kept : std::uint8_t {
    kNone,
    kAll,         // as after a process was killed
    kHalfOfLast,  // all, but only the first half of the last
    kEverySecond  // the disk has an order of its own
  };
  static constexpr std::array kAllKept{Kept::kNone, Kept::kAll, Kept::kHalfOfLast,
                                       Kept::kEverySecond};

  UnluckyDisk(Fate fate, int at_call)
      : fate_(fate), at_call_(at_call), real_(sqlite3_vfs_find(nullptr)), vfs_(*real_) {
    vfs_.zName = "unlucky";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + real_->szOsFile;
    vfs_.pAppData = this;
    vfs_.xOpen = &Open;
    vfs_.xDelete = &Delete;
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~UnluckyDisk() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(real_, 1);
  }
  UnluckyDisk(const UnluckyDisk&) = delete;
  UnluckyDisk& operator=(const UnluckyDisk&) = delete;

  // Returns whether its call has come.
  [[nodiscard]] bool struck() const { return struck_; }
  // Writes what is found when the power is back into a folder.
  void RestoreInto(const std::filesystem::path& folder, Kept kept) const {
    for (const auto& [path, file] : files_) {
      const auto bytes = file.Found(kept);
      if (!bytes) continue;
      std::ofstream stream(folder / std::filesystem::path(path).filename(), std::ios::binary);
      stream.write(bytes->data(), static_cast<std::streamsize>(bytes->size()));
    }
  }

 private:
  struct Write {
    std::size_t at = 0;
    std::string bytes{};
    bool cuts = false;  // the file ends there
  };
  struct Platter {
    std::optional<std::string> bytes{};  // empty if there is no such file
    std::vector<Write> unsynced{};
    bool deleted = false;  // its folder may not know it yet

    static void Do(const Write& write, std::size_t size, std::string& to) {
      if (write.cuts) return to.resize(write.at);
      to.resize(std::max(to.size(), write.at + size));
      to.replace(write.at, size, write.bytes, 0, size);
    }
    void Sync() {
      if (!bytes) bytes.emplace();
      for (const Write& write : unsynced) Do(write, write.bytes.size(), *bytes);
      unsynced.clear();
    }
    [[nodiscard]] std::optional<std::string> Found(Kept kept) const {
      if (kept == Kept::kNone || (!bytes && unsynced.empty())) return bytes;
      if (deleted) return kept == Kept::kEverySecond ? bytes : std::nullopt;
      std::string found = bytes.value_or("");
      for (std::size_t i = 0; i < unsynced.size(); ++i) {
        const bool is_last = i + 1 == unsynced.size();
        const std::size_t size = unsynced[i].bytes.size();
        if (kept == Kept::kEverySecond && i % 2 == 0) continue;
        Do(unsynced[i], kept == Kept::kHalfOfLast && is_last ? size / 2 : size, found);
      }
      return found;
    }
  };
  // This is SQLite's file, with the real one behind it.
  struct File : sqlite3_file {
    UnluckyDisk* disk;
    Platter* platter;
    bool is_new_log;  // a log of either kind, with which SQLite syncs its folder
    [[nodiscard]] sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };

  // Returns what happens to this call instead, or SQLITE_OK for nothing.
  int Strike(int error) {
    const bool now = calls_++ == at_call_;
    struck_ = struck_ || now;
    return now || (struck_ && fate_ == Fate::kPowerGoes) ? error : SQLITE_OK;
  }

  static File& Of(sqlite3_file* file) { return *static_cast<File*>(file); }
  template <typename Work>
  static int Do(sqlite3_file* file, int error, const Work& work) {
    File& ours = Of(file);
    const int struck = ours.disk->Strike(error);
    return struck != SQLITE_OK ? struck : work(ours, ours.real());
  }

  static int Open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out) {
    auto* const disk = static_cast<UnluckyDisk*>(vfs->pAppData);
    file->pMethods = nullptr;
    if (const int struck = disk->Strike(SQLITE_CANTOPEN); struck != SQLITE_OK) return struck;
    File& ours = *new (file) File{};
    const std::string path = name == nullptr ? "" : name;
    const bool was_there = std::filesystem::exists(path);
    const int opened = disk->real_->xOpen(disk->real_, name, ours.real(), flags, out);
    if (opened != SQLITE_OK) return opened;
    ours.disk = disk;
    auto [at, is_new] = disk->files_.try_emplace(path);
    ours.platter = &at->second;
    // The name of a database is on the platter before SQLite sees it.
    if (is_new && was_there) {
      std::ifstream stream(path, std::ios::binary);
      at->second.bytes.emplace(std::istreambuf_iterator<char>(stream),
                               std::istreambuf_iterator<char>());
    } else if (is_new && (flags & SQLITE_OPEN_MAIN_DB) != 0) {
      at->second.bytes.emplace();
    } else if (!was_there) {
      at->second.unsynced.push_back({.cuts = true});
      at->second.deleted = false;
    }
    constexpr int kLogs = SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_SUPER_JOURNAL | SQLITE_OPEN_WAL;
    ours.is_new_log = !was_there && (flags & kLogs) != 0;
    ours.pMethods = &Methods();
    return SQLITE_OK;
  }
  static int Delete(sqlite3_vfs* vfs, const char* name, int sync) {
    auto* const disk = static_cast<UnluckyDisk*>(vfs->pAppData);
    if (const int struck = disk->Strike(SQLITE_IOERR_DELETE); struck != SQLITE_OK) return struck;
    disk->files_[name].deleted = true;
    if (sync != 0) disk->SyncFolder();
    return disk->real_->xDelete(disk->real_, name, 0);
  }
  void SyncFolder() {
    for (auto& [path, file] : files_) {
      if (file.deleted) file = {.deleted = true};
    }
  }

  static const sqlite3_io_methods& Methods() {
    static const sqlite3_io_methods kMethods = [] {
      sqlite3_io_methods methods{};
      methods.iVersion = 1;
      methods.xClose = [](sqlite3_file* file) {
        return Of(file).real()->pMethods->xClose(Of(file).real());
      };
      methods.xRead = [](sqlite3_file* file, void* to, int size, sqlite3_int64 at) {
        return Do(file, SQLITE_IOERR_READ, [&](File&, sqlite3_file* real) {
          return real->pMethods->xRead(real, to, size, at);
        });
      };
      methods.xWrite = [](sqlite3_file* file, const void* from, int size, sqlite3_int64 at) {
        return Do(file, SQLITE_FULL, [&](File& ours, sqlite3_file* real) {
          ours.platter->unsynced.push_back(
              {static_cast<std::size_t>(at),
               std::string(static_cast<const char*>(from), static_cast<std::size_t>(size))});
          return real->pMethods->xWrite(real, from, size, at);
        });
      };
      methods.xTruncate = [](sqlite3_file* file, sqlite3_int64 size) {
        return Do(file, SQLITE_IOERR_TRUNCATE, [&](File& ours, sqlite3_file* real) {
          ours.platter->unsynced.push_back({.at = static_cast<std::size_t>(size), .cuts = true});
          return real->pMethods->xTruncate(real, size);
        });
      };
      methods.xSync = [](sqlite3_file* file, int) {
        return Do(file, SQLITE_IOERR_FSYNC, [&](File& ours, sqlite3_file*) {
          ours.platter->Sync();
          if (std::exchange(ours.is_new_log, false)) ours.disk->SyncFolder();
          return SQLITE_OK;
        });
      };
      methods.xFileSize = [](sqlite3_file* file, sqlite3_int64* size) {
        return Of(file).real()->pMethods->xFileSize(Of(file).real(), size);
      };
      methods.xLock = [](sqlite3_file* file, int lock) {
        return Of(file).real()->pMethods->xLock(Of(file).real(), lock);
      };
      methods.xUnlock = [](sqlite3_file* file, int lock) {
        return Of(file).real()->pMethods->xUnlock(Of(file).real(), lock);
      };
      methods.xCheckReservedLock = [](sqlite3_file* file, int* out) {
        return Of(file).real()->pMethods->xCheckReservedLock(Of(file).real(), out);
      };
      methods.xFileControl = [](sqlite3_file* file, int what, void* with) {
        return Of(file).real()->pMethods->xFileControl(Of(file).real(), what, with);
      };
      methods.xSectorSize = [](sqlite3_file* file) {
        return Of(file).real()->pMethods->xSectorSize(Of(file).real());
      };
      methods.xDeviceCharacteristics = [](sqlite3_file* file) {
        return Of(file).real()->pMethods->xDeviceCharacteristics(Of(file).real());
      };
      return methods;
    }();
    return kMethods;
  }

  const Fate fate_;
  const int at_call_;
  int calls_ = 0;
  bool struck_ = false;
  sqlite3_vfs* real_;
  sqlite3_vfs vfs_;
  std::map<std::string, Platter> files_;
};

// This is something that a store is told, and how to ask whether it has it.
template <typename Store>
struct Told {
  std::function<Result<void>(Store&)> tell;
  std::function<bool(Store&)> is_there;
};

// Tells a new store all of these, and opens it anew in the middle. It repeats this for each of the
// store's calls to the disk, at which the power or the call fails. Afterwards the store has
// whatever it said that it has; it throws nothing and reports what failed; and if one call alone
// has failed, it stores again what it is told later.
template <typename Store>
void ExpectThatNothingTakenIsLost(
    const std::function<Result<std::unique_ptr<Store>>(const std::filesystem::path&)>& open,
    const std::vector<Told<Store>>& all) {
  const auto expect_has = [&](const std::filesystem::path& file,
                              const std::vector<std::size_t>& taken, const std::string& when) {
    auto store = open(file);
    ASSERT_TRUE(store) << when << ": " << store.error().message;
    for (const std::size_t i : taken) {
      EXPECT_TRUE(all[i].is_there(**store))
          << when << ": what was told as number " << i << " is lost";
    }
  };
  for (const auto fate : {UnluckyDisk::Fate::kPowerGoes, UnluckyDisk::Fate::kCallFails}) {
    bool struck = true;
    for (int call = 0; struck && !testing::Test::HasFailure(); ++call) {
      const bool power_goes = fate == UnluckyDisk::Fate::kPowerGoes;
      const std::string when =
          fmt::format("{} at call {}", power_goes ? "the power goes" : "the disk fails", call);
      const TempDir folder;
      std::vector<std::size_t> taken;
      std::array<TempDir, UnluckyDisk::kAllKept.size()> found;
      {
        UnluckyDisk disk(fate, call);
        Result<std::unique_ptr<Store>> store = open(folder / "store");
        for (std::size_t i = 0; i < all.size(); ++i) {
          if (i == all.size() / 2 && store) {
            store->reset();
            store = open(folder / "store");
          }
          if (!store && !power_goes) store = open(folder / "store");
          if (!store) {
            EXPECT_NE(store.error().message, "") << when;
            break;
          }
          const bool struck_before = disk.struck();
          const auto told = all[i].tell(**store);
          if (told) taken.push_back(i);
          EXPECT_TRUE(told || !told.error().message.empty()) << when;
          EXPECT_TRUE(told || disk.struck()) << when << ": " << told.error().message;
          EXPECT_TRUE(told || power_goes || !struck_before)
              << when << ": it goes on failing: " << told.error().message;
        }
        if (store) store->reset();
        struck = disk.struck();
        for (std::size_t i = 0; i < found.size(); ++i) {
          disk.RestoreInto(found[i].path(), UnluckyDisk::kAllKept[i]);
        }
      }
      const UnluckyDisk sound(UnluckyDisk::Fate::kCallFails, -1);
      if (!power_goes) {
        expect_has(folder / "store", taken, when);
        continue;
      }
      for (std::size_t i = 0; i < found.size(); ++i) {
        expect_has(found[i] / "store", taken, fmt::format("{}, found as {}", when, i));
      }
    }
    EXPECT_FALSE(struck);
  }
}

}  // namespace trailcast::test
