// This fuzzes what a route server sends as the fleet's list of revoked certificates.
#include "services/security/revocation_list.h"

#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;
using namespace trailcast::security;

namespace {

// The seeds are lists of this authority.
constexpr const char* kAuthority = R"(-----BEGIN CERTIFICATE-----
MIIBTTCB9aADAgECAhBGo3DiwGrZJqg/YmGJN3P+MAoGCCqGSM49BAMCMB4xHDAa
BgNVBAMME3RyYWlsY2FzdCBhdXRob3JpdHkwIBcNMjYxMTIzMTE1NDI0WhgPMjEy
NjEwMzExMTU0MjRaMB4xHDAaBgNVBAMME3RyYWlsY2FzdCBhdXRob3JpdHkwWTAT
BgcqhkjOPQIBBggqhkjOPQMBBwNCAAT7zgBEKpmcbExg0hEqO2beZSxPkXGJo6Ex
rtm53rUP/8bLCBeOm6yKL+IwEJPdW8ybgYnbhlhYHVPTmJdPqZMNoxMwETAPBgNV
HRMBAf8EBTADAQH/MAoGCCqGSM49BAMCA0cAMEQCICKaUmnPDwywnb7a+T62Bt2e
rvOXOpbFlW6h62Be74Q+AiBrw2eBxbZmLY4601nMYHbxuDGtFwWS0TDQ+rCnqCuc
2Q==
-----END CERTIFICATE-----
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const auto list = ReadRevocationList(text, kAuthority);
  if (!list) return 0;
  const auto again = ReadRevocationList(list->text, kAuthority);
  Require(again && again->text == list->text && again->number == list->number &&
              again->issued == list->issued && again->serials == list->serials,
          "a list is what it says without what stood around it");
  return 0;
}
