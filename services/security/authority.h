#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/base/result.h"
#include "services/security/certificates.h"
#include "services/security/member.h"

namespace trailcast::security {

// The fleet's authority: a folder that stays on one machine, whose key signs who is a member and
// what it may do. Below it, members/NAME/ is what is copied to that member's machine (member_keys.h
// reads it); issued/NAME.GENERATION.pem are the certificates ever given. Not meant to be worked on
// by two processes at once.
class Authority {
 public:
  // kConflict if the folder has an authority already; it is never replaced.
  [[nodiscard]] static Result<Authority> Create(const std::filesystem::path& folder, Time now,
                                                int days);
  // kNotFound if there is none.
  [[nodiscard]] static Result<Authority> Open(const std::filesystem::path& folder);

  // A new member; its folder. kConflict if there is one of that name, revoked or not.
  [[nodiscard]] Result<std::filesystem::path> Add(const std::string& name, Role role, Time now,
                                                  int days) const;
  // New keys for a member, the next generation, perhaps in another role: then the earlier ones are
  // revoked. Also takes back who was revoked.
  [[nodiscard]] Result<std::filesystem::path> Renew(const std::string& name,
                                                    std::optional<Role> role, Time now,
                                                    int days) const;
  // Puts all certificates of the member on the list of revoked ones, in every member's folder here.
  [[nodiscard]] Result<void> Revoke(const std::string& name, Time now) const;

  enum class State : std::uint8_t { kValid, kExpired, kRevoked };
  struct Row {
    std::string name;
    Member member;  // of the latest generation
    Time expires;
    State state = State::kValid;
  };
  [[nodiscard]] Result<std::vector<Row>> List(Time now) const;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  // The list of revoked certificates, which goes to every member's machine.
  [[nodiscard]] std::filesystem::path RevocationFile() const;

 private:
  Authority(std::filesystem::path folder, Identity identity, std::string name_key, Time until)
      : folder_(std::move(folder)),
        identity_(std::move(identity)),
        name_key_(std::move(name_key)),
        until_(until) {}

  struct Issued {
    std::uint32_t generation = 0;
    CertificateFacts facts;
    Member member;
  };
  // Of one member, by generation; empty if there is no such member.
  [[nodiscard]] Result<std::vector<Issued>> IssuedTo(const std::string& name) const;
  [[nodiscard]] Result<std::vector<std::string>> Names() const;
  [[nodiscard]] Result<std::filesystem::path> Give(const std::string& name, const Member& member,
                                                   Time now, int days) const;
  [[nodiscard]] Result<void> RevokeSerials(const std::vector<Issued>& issued, Time now) const;
  // A member for the fleet's lists; kNotFound names those there are.
  [[nodiscard]] Result<std::vector<Issued>> Known(const std::string& name) const;

  std::filesystem::path folder_;
  Identity identity_;
  std::string name_key_;
  Time until_;  // the authority's own end
};

}  // namespace trailcast::security
