#pragma once

#include <cstddef>
#include <iterator>
#include <list>
#include <map>
#include <utility>

namespace trailcast {

// A map of bounded size, for keys that strangers can make up. Beyond `most` entries it drops the
// one that was untouched for longest.
template <typename Key, typename Value>
class NewestMap {
 public:
  explicit NewestMap(std::size_t most) : most_(most) {}

  [[nodiscard]] const Value* Find(const Key& key) const {
    const auto found = where_.find(key);
    return found == where_.end() ? nullptr : &found->second->second;
  }
  [[nodiscard]] Value* Find(const Key& key) {
    const auto found = where_.find(key);
    return found == where_.end() ? nullptr : &found->second->second;
  }
  // Returns the key's value, which is made if there is none, as the newest entry. `gone` receives
  // the key and the value of an entry that had to be dropped for it.
  template <typename Gone>
  Value& Touch(const Key& key, const Gone& gone) {
    if (const auto found = where_.find(key); found != where_.end()) {
      entries_.splice(entries_.end(), entries_, found->second);
      return found->second->second;
    }
    if (entries_.size() >= most_) {
      const auto [oldest, value] = std::move(entries_.front());
      where_.erase(oldest);
      entries_.pop_front();
      gone(oldest, value);
    }
    entries_.emplace_back(key, Value{});
    where_.emplace(key, std::prev(entries_.end()));
    return entries_.back().second;
  }
  Value& Touch(const Key& key) {
    return Touch(key, [](const Key&, const Value&) {});
  }
  void Erase(const Key& key) {
    const auto found = where_.find(key);
    if (found == where_.end()) return;
    entries_.erase(found->second);
    where_.erase(found);
  }
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  // The entry that was touched last comes last.
  [[nodiscard]] auto begin() const { return entries_.begin(); }
  [[nodiscard]] auto end() const { return entries_.end(); }
  // Values may be changed, but keys may not.
  [[nodiscard]] auto begin() { return entries_.begin(); }
  [[nodiscard]] auto end() { return entries_.end(); }

 private:
  using Entries = std::list<std::pair<Key, Value>>;

  std::size_t most_;
  Entries entries_;  // the one that was touched last at the end
  std::map<Key, typename Entries::iterator> where_;
};

}  // namespace trailcast
