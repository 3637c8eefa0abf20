#include "services/http/tls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/bio.h>
#include <openssl/ssl.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "services/http/server.h"
#include "tests/support/await.h"
#include "tests/support/strangers/hostile_client.h"
#include "tests/support/strangers/self_signed.h"
#include "tests/support/temp_dir.h"

namespace trailcast::http {
namespace {

using test::RawConnection;
using testing::AllOf;
using testing::HasSubstr;

class TlsTest : public testing::Test {
 protected:
  void SetUp() override {
    server_.Get("/hello", [](const httplib::Request& request, httplib::Response& response) {
      response.set_content("hello " + request.remote_addr, "text/plain");
    });
    server_.Get("/long", [](const httplib::Request&, httplib::Response& response) {
      response.set_content(std::string(kLong, 'x'), "text/plain");
    });
    server_.Post("/length", [](const httplib::Request& request, httplib::Response& response) {
      response.set_content(std::to_string(request.body.size()), "text/plain");
    });
    server_.Speak(Tls::Load(files_.certificate, files_.key).value());
    ASSERT_TRUE(server_.Listen("127.0.0.1", 0));
  }
  [[nodiscard]] std::unique_ptr<httplib::SSLClient> Client() const {
    auto client = std::make_unique<httplib::SSLClient>("localhost", server_.port());
    client->set_ca_cert_path(files_.certificate.c_str());
    client->enable_server_certificate_verification(true);
    client->set_read_timeout(test::kLongEnough);
    return client;
  }
  [[nodiscard]] int Hello() const {
    const auto got = Client()->Get("/hello");
    return got ? got->status : 0;
  }

  static constexpr std::size_t kLong = 8U << 20U;
  test::TempDir folder_;
  test::SelfSigned files_ = test::MakeSelfSigned(folder_ / "");
  Server server_{{.threads = 3, .waiting = 8, .body_bytes = 64U << 10U},
                 [](const Error& error) { ADD_FAILURE() << error.message; }};
};

TEST_F(TlsTest, ServesWhoTrustsItsCertificate) {
  const auto hello = Client()->Get("/hello");
  ASSERT_TRUE(hello) << httplib::to_string(hello.error());
  EXPECT_EQ(hello->body, "hello 127.0.0.1");
  const auto whole = Client()->Get("/long");
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->body.size(), kLong);
  const auto post = Client()->Post("/length", std::string(64U << 10U, 'x'), "text/plain");
  ASSERT_TRUE(post);
  EXPECT_EQ(post->body, "65536");
}

TEST_F(TlsTest, WhoSpeaksNoTlsGetsNothingOfIt) {
  const RawConnection client(server_.port());
  client.Send("GET /hello HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_THAT(client.Receive(), testing::Not(HasSubstr("hello")));
  EXPECT_EQ(Hello(), 200);
}

class GreetingTest : public TlsTest {
 protected:
  // The cipher and the group that were agreed upon; "": none were.
  [[nodiscard]] std::string Agreed(int version, const char* groups, const char* ciphers) const {
    const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(
        SSL_CTX_new(TLS_client_method()), SSL_CTX_free);
    SSL_CTX_set_max_proto_version(context.get(), version);
    EXPECT_EQ(SSL_CTX_set1_groups_list(context.get(), groups), 1);
    EXPECT_EQ(version == TLS1_3_VERSION ? SSL_CTX_set_ciphersuites(context.get(), ciphers)
                                        : SSL_CTX_set_cipher_list(context.get(), ciphers),
              1);
    const std::unique_ptr<BIO, decltype(&BIO_free_all)> bio(BIO_new_ssl_connect(context.get()),
                                                            BIO_free_all);
    BIO_set_conn_hostname(bio.get(), ("127.0.0.1:" + std::to_string(server_.port())).c_str());
    if (BIO_do_handshake(bio.get()) != 1) return "";
    SSL* ssl = nullptr;
    BIO_get_ssl(bio.get(), &ssl);
    return std::string(SSL_get_cipher_name(ssl)) + " " + OBJ_nid2sn(SSL_get_negotiated_group(ssl));
  }
};

// They cost this side hundreds of times what they cost a client that only pretends to reckon.
TEST_F(GreetingTest, NoFiniteFieldsAreOffered) {
  constexpr const char* kAes = "TLS_AES_256_GCM_SHA384";
  for (const char* group : {"ffdhe2048", "ffdhe8192", "X448", "P-521"}) {
    EXPECT_EQ(Agreed(TLS1_3_VERSION, group, kAes), "") << group;
  }
  EXPECT_EQ(Agreed(TLS1_3_VERSION, "ffdhe8192:P-384", kAes), std::string(kAes) + " secp384r1");
}

TEST_F(GreetingTest, TheServerChoosesTheCipherButForWhoHasNoHardwareForAes) {
  const auto agreed = [&](const char* ciphers) { return Agreed(TLS1_2_VERSION, "P-256", ciphers); };
  constexpr const char* kAes = "ECDHE-ECDSA-AES256-GCM-SHA384 prime256v1";
  EXPECT_EQ(agreed("ECDHE-ECDSA-AES256-GCM-SHA384:ECDHE-ECDSA-AES128-GCM-SHA256"), kAes);
  EXPECT_EQ(agreed("ECDHE-ECDSA-AES128-GCM-SHA256:ECDHE-ECDSA-AES256-GCM-SHA384"), kAes);
  EXPECT_EQ(agreed("ECDHE-ECDSA-CHACHA20-POLY1305:ECDHE-ECDSA-AES256-GCM-SHA384"),
            "ECDHE-ECDSA-CHACHA20-POLY1305 prime256v1");
  EXPECT_EQ(agreed("AES256-GCM-SHA384"), "") << "without forward secrecy";
}

TEST_F(TlsTest, WhoGreetsSlowlyOrNeverIsDoneWith) {
  std::vector<std::unique_ptr<RawConnection>> silent;
  for (int i = 0; i < 6; ++i) {
    silent.push_back(std::make_unique<RawConnection>(server_.port()));
    silent.back()->Send("\x16\x03\x01\x02");  // a handshake begins
  }
  EXPECT_EQ(Hello(), 200);
}

// A body without length, or an endless request, costs next to nothing, as over plain HTTP.
TEST_F(TlsTest, RequestsWithoutEndTakeNoMemory) {
  ASSERT_EQ(Hello(), 200);
  [[maybe_unused]] const std::size_t before = test::ResidentBytes();
  constexpr std::size_t kTooMuch = 200U << 20U;
  const auto send_for_ever = [&](const std::string& content_type) {
    auto client = Client();
    client->set_write_timeout(20);
    std::size_t sent = 0;
    const std::string chunk(0x10000, 'x');
    (void)client->Post(
        "/length",
        [&](std::size_t, httplib::DataSink& sink) {
          sent += chunk.size();
          return sent < kTooMuch && sink.write(chunk.data(), chunk.size());
        },
        content_type);
    return sent;
  };
  EXPECT_LT(send_for_ever("text/plain"), 16U << 20U) << "chunked";
  auto endless = Client();
  (void)endless->Get("/" + std::string(16U << 20U, 'x'));
  EXPECT_EQ(Hello(), 200);
#if !defined(TRAILCAST_ASAN)  // it keeps what was freed
  // The memory of this process's own clients counts, too.
  EXPECT_LT(test::ResidentBytes(), before + (64U << 20U));
#endif
}

TEST_F(TlsTest, FilesThatCannotBeUsedAreNamed) {
  const test::SelfSigned other = test::MakeSelfSigned(folder_ / "", "other");
  const auto why = [](const std::filesystem::path& certificate, const std::filesystem::path& key) {
    const auto tls = Tls::Load(certificate, key);
    return tls ? "" : tls.error().message;
  };
  EXPECT_EQ(why(other.certificate, other.key), "");
  EXPECT_THAT(why(folder_ / "none", files_.key),
              AllOf(HasSubstr("the certificate in"), HasSubstr("openssl req")));
  EXPECT_THAT(why(files_.certificate, folder_ / "none"), HasSubstr("the key in"));
  EXPECT_THAT(why(files_.certificate, other.key), HasSubstr("the key in")) << "of another";
  std::ofstream(folder_ / "nonsense") << "nonsense";
  EXPECT_THAT(why(folder_ / "nonsense", files_.key), HasSubstr("the certificate in"));
}

TEST_F(TlsTest, FilesThatAreRenewedAreTakenUp) {
  const test::SelfSigned mine = test::MakeSelfSigned(folder_ / "", "mine");
  const auto tls = Tls::Load(mine.certificate, mine.key, std::chrono::milliseconds(0)).value();
  const auto first = tls.Context();
  EXPECT_EQ(tls.Context(), first);
  const test::SelfSigned renewed = test::MakeSelfSigned(folder_ / "", "renewed");
  std::filesystem::rename(renewed.certificate, mine.certificate);
  EXPECT_EQ(tls.Context(), first) << "which has no key yet";
  std::filesystem::rename(renewed.key, mine.key);
  EXPECT_NE(tls.Context(), first);
}

}  // namespace
}  // namespace trailcast::http
