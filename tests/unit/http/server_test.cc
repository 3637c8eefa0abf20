#include "services/http/server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/await.h"
#include "tests/support/strangers/hostile_client.h"

namespace trailcast::http {
namespace {

using test::RawConnection;
using testing::HasSubstr;

void Complain(const Error& error) { ADD_FAILURE() << error.message; }

class HttpServerTest : public testing::Test {
 protected:
  void SetUp() override {
    server_.Get("/hello", [](const httplib::Request&, httplib::Response& response) {
      response.set_content("hello", "text/plain");
    });
    server_.Post("/length", [](const httplib::Request& request, httplib::Response& response) {
      response.set_content(std::to_string(request.body.size()), "text/plain");
    });
    ASSERT_TRUE(server_.Listen("127.0.0.1", 0));
  }
  [[nodiscard]] int Hello() {
    httplib::Client client("127.0.0.1", server_.port());
    client.set_read_timeout(test::kLongEnough);
    const auto got = client.Get("/hello");
    return got ? got->status : 0;
  }

  Server server_{{.threads = 3, .waiting = 8, .body_bytes = 64U << 10U}, Complain};
};

TEST_F(HttpServerTest, TakesBodiesUpToItsBound) {
  httplib::Client client("127.0.0.1", server_.port());
  const auto all = client.Post("/length", std::string(64U << 10U, 'x'), "text/plain");
  ASSERT_TRUE(all);
  EXPECT_EQ(all->body, "65536");
  const auto more = client.Post("/length", std::string((64U << 10U) + 1, 'x'), "text/plain");
  if (more) {
    EXPECT_EQ(more->status, 413);
  }
}

TEST(HttpServer, SomeRequestsMayBringMoreThanOthers) {
  Server server({.threads = 2, .body_bytes = 1000}, Complain);
  const auto tell_length = [](const httplib::Request& request, httplib::Response& response) {
    response.set_content(std::to_string(request.body.size()), "text/plain");
  };
  server.Post("/file", tell_length);
  server.Post("/length", tell_length);
  server.Allow({.method = "POST",
                .path = "/file",
                .body_bytes = 1U << 20U,
                .patience = std::chrono::seconds(20)});
  ASSERT_TRUE(server.Listen("127.0.0.1", 0));
  httplib::Client client("127.0.0.1", server.port());
  const auto post = [&](const char* path, std::size_t bytes) {
    const auto got = client.Post(path, std::string(bytes, 'x'), "application/octet-stream");
    return got ? got->body : "refused while it was sent";
  };
  EXPECT_EQ(post("/file", 1U << 20U), "1048576");
  EXPECT_EQ(post("/length", 1000), "1000");
  const auto answer = [&](const std::string& head) {
    const RawConnection raw(server.port());
    raw.Send("POST " + head + "\r\n\r\n");
    return raw.Receive();
  };
  EXPECT_THAT(answer("/length HTTP/1.1\r\nHost: x\r\nContent-Length: 1001"), HasSubstr("413"));
  EXPECT_THAT(answer("/file HTTP/1.1\r\nHost: x\r\nContent-Length: 1048577"), HasSubstr("413"));
  EXPECT_THAT(answer("/file HTTP/1.1\r\nHost: x\r\nContent-Length: -1"), HasSubstr("413"));
  EXPECT_THAT(answer("/file HTTP/1.1\r\nHost: x"), HasSubstr("411"));
  EXPECT_THAT(answer("/length HTTP/1.1\r\nHost: x\r\nContent-Encoding: gzip\r\nContent-Length: 9"),
              HasSubstr("411"));
}

TEST(HttpServer, WhatItsThreadsThrowIsToldAndEndsThatAnswerAlone) {
  std::mutex mutex;
  std::vector<std::string> complaints;
  Server server({.threads = 2}, [&](const Error& error) {
    const std::scoped_lock lock(mutex);
    complaints.push_back(error.message);
  });
  server.Get("/throws", [](const httplib::Request&, httplib::Response&) {
    throw std::runtime_error("no such robot");
  });
  server.Get("/breaks-off", [](const httplib::Request&, httplib::Response& response) {
    response.set_content_provider(
        1000, "text/plain",
        [](std::size_t, std::size_t, httplib::DataSink&) -> bool { throw std::bad_alloc(); });
  });
  server.Get("/hello", [](const httplib::Request&, httplib::Response& response) {
    response.set_content("hello", "text/plain");
  });
  ASSERT_TRUE(server.Listen("127.0.0.1", 0));
  const auto told = [&](std::size_t count, const std::string& what) {
    const std::scoped_lock lock(mutex);
    return complaints.size() == count && complaints.back().find(what) != std::string::npos;
  };
  httplib::Client client("127.0.0.1", server.port());
  const auto thrown = client.Get("/throws");
  ASSERT_TRUE(thrown);
  EXPECT_EQ(thrown->status, 500);
  EXPECT_THAT(thrown->body, HasSubstr("its log says"));
  EXPECT_TRUE(told(1, "no such robot"));
  EXPECT_FALSE(client.Get("/breaks-off")) << "it has begun already";
  test::Await([&] { return told(2, "bad_alloc"); }, "word of what was thrown");
  for (int i = 0; i < 4; ++i) {
    const auto hello = client.Get("/hello");
    ASSERT_TRUE(hello);
    EXPECT_EQ(hello->status, 200) << "no thread is lost";
  }
}

TEST_F(HttpServerTest, WhatIsJudgedIsRefusedBeforeItsBodyIsRead) {
  Server judged({.body_bytes = 1000}, Complain);
  judged.Post("/length", [](const httplib::Request&, httplib::Response&) { FAIL(); });
  judged.JudgeBy(
      [](const httplib::Request&) {
        return Refusal{403, "not you"};
      },
      [](const Refusal& refusal, httplib::Response& response) {
        response.status = refusal.status;
        response.set_content(refusal.why, "text/plain");
      });
  ASSERT_TRUE(judged.Listen("127.0.0.1", 0));
  const RawConnection client(judged.port());
  client.Send("POST /length HTTP/1.1\r\nHost: x\r\nContent-Length: 900\r\n\r\n");
  const std::string answer = client.Receive();
  EXPECT_THAT(answer, HasSubstr("403"));
}

// A chunked body of 200 MB, an endless request line and the like cost next to nothing.
TEST_F(HttpServerTest, RequestsWithoutEndTakeNoMemory) {
  ASSERT_EQ(Hello(), 200);
  const std::size_t before = test::ResidentBytes();
  const std::string chunk = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
  const std::string post = "POST /length HTTP/1.1\r\nHost: x\r\n";
  constexpr std::size_t kWithSocketBuffers = 16U << 20U;
  for (const auto& [beginning, more] : std::vector<std::pair<std::string, std::string>>{
           {"GET /", std::string(100'000, 'x')},
           {"GET /hello HTTP/1.1\r\n", "X-More: " + std::string(1000, 'x') + "\r\n"},
           {post + "Transfer-Encoding: chunked\r\n\r\n", chunk},
           {"GET /hello HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n", chunk},
           {post + "Transfer-Encoding: gzip\r\nContent-Length: 70000\r\n\r\n", chunk},
           {post + "Content-Length: 1000000000000\r\n\r\n", std::string(100'000, 'x')}}) {
    EXPECT_LT(RawConnection(server_.port()).SendForEver(beginning, more), kWithSocketBuffers)
        << beginning;
    EXPECT_EQ(Hello(), 200) << beginning;
  }
  EXPECT_LT(test::ResidentBytes(), before + (16U << 20U));
}

TEST_F(HttpServerTest, ABodyOfUnknownLengthIsRefused) {
  const RawConnection client(server_.port());
  client.Send("POST /length HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\n\r\n");
  EXPECT_THAT(client.Receive(), HasSubstr(" 411 "));
}

// As 'curl -X POST' and 'curl -X DELETE' send it, and wait for the answer.
TEST_F(HttpServerTest, WhatSaysNothingOfABodyHasNone) {
  server_.Delete("/hello", [](const httplib::Request&, httplib::Response& response) {
    response.set_content("gone", "text/plain");
  });
  for (const auto& [request, answer] : std::vector<std::pair<std::string, std::string>>{
           {"POST /length", "\r\n\r\n0"}, {"DELETE /hello", "\r\n\r\ngone"}}) {
    const RawConnection client(server_.port());
    client.Send(request + " HTTP/1.1\r\nHost: x\r\n\r\n");
    const std::string got = client.ReceiveAll();
    EXPECT_THAT(got, HasSubstr(" 200 ")) << request;
    EXPECT_THAT(got, testing::EndsWith(answer)) << request;
  }
}

// Eight kilobytes of ranges would have a hundred megabytes sent of a page that anybody may ask for
// (CVE-2011-3192).
TEST_F(HttpServerTest, PartsOfAnAnswerAreNotServed) {
  std::string ranges = "0-4";
  for (int i = 0; i < 1000; ++i) ranges += ",0-4";
  const RawConnection client(server_.port());
  client.Send("GET /hello HTTP/1.1\r\nHost: x\r\nRange: bytes=" + ranges + "\r\n\r\n");
  const std::string got = client.ReceiveAll();
  EXPECT_THAT(got, HasSubstr(" 200 "));
  EXPECT_THAT(got, testing::EndsWith("\r\n\r\nhello"));
}

class AnyBodyTest : public testing::Test {
 protected:
  void SetUp() override {
    server_.PostWithAnyBody(
        "/stop/([A-Za-z]+)", [](const httplib::Request& request, httplib::Response& response) {
          response.set_content(request.matches[1].str() + ":" + request.body + ".", "text/plain");
        });
    ASSERT_TRUE(server_.Listen("127.0.0.1", 0));
  }
  [[nodiscard]] std::string Answer(const std::string& head, const std::string& body = "") {
    const RawConnection client(server_.port());
    client.Send("POST /stop/robot HTTP/1.1\r\nHost: x\r\n" + head + "\r\n" + body);
    return client.ReceiveAll();
  }

  Server server_{{.threads = 2, .body_bytes = 100}, Complain};
};

TEST_F(AnyBodyTest, ItIsObeyedAndGivenTheBodyIfThatCame) {
  using testing::EndsWith;
  const std::string chunked = "Transfer-Encoding: chunked\r\n";
  const std::string multipart = "Content-Type: multipart/form-data; boundary=x\r\n";
  EXPECT_THAT(Answer(""), EndsWith("robot:."));
  EXPECT_THAT(Answer("Content-Length: 0\r\n"), EndsWith("robot:."));
  EXPECT_THAT(Answer("Content-Length: 3\r\n", "why"), EndsWith("robot:why."));
  EXPECT_THAT(
      Answer("Content-Type: application/x-www-form-urlencoded\r\nContent-Length: 3\r\n", "why"),
      EndsWith("robot:why."));
  EXPECT_THAT(Answer(chunked, "3\r\nwhy\r\n0\r\n\r\n"), EndsWith("robot:why."));
  EXPECT_THAT(Answer(chunked, "no number\r\n"), EndsWith("robot:."));
  EXPECT_THAT(Answer(multipart + "Content-Length: 3\r\n", "why"), EndsWith("robot:."));
  EXPECT_THAT(Answer("Content-Type: multipart/form-data\r\nContent-Length: 3\r\n", "why"),
              EndsWith("robot:."));
  EXPECT_THAT(Answer("Content-Encoding: gzip\r\nContent-Length: 3\r\n", "why"),
              EndsWith("robot:."));
  EXPECT_THAT(Answer("Content-Encoding: nonsense\r\nContent-Length: 3\r\n", "why"),
              EndsWith("robot:why."));
  EXPECT_THAT(Answer("Transfer-Encoding: gzip\r\n", "why"), EndsWith("robot:."));
  EXPECT_THAT(Answer("Content-Length: -3\r\n", "why"), EndsWith("robot:."));
  EXPECT_THAT(Answer("Content-Length: 1000000000000\r\n"), EndsWith("robot:."));
}

TEST_F(AnyBodyTest, ItIsObeyedHoweverItIsSpelled) {
  for (const char* line :
       {"POST /stop/Robot HTTP/1.1", "POST /stop/Robot/ HTTP/1.1", "POST //stop///Robot// HTTP/1.1",
        "POST /STOP/Robot HTTP/1.1", "POST /sTop/%52obot/?why=rain HTTP/1.1",
        "POST http://x/stop/Robot HTTP/1.1", "POST HTTP://x:80//Stop/Robot/ HTTP/1.1",
        "post /stop/Robot HTTP/1.1", "Post /stop/Robot HTTP/1.0"}) {
    for (const char* host : {"Host: x\r\n", ""}) {
      const RawConnection client(server_.port());
      client.Send(std::string(line) + "\r\n" + host + "\r\n");
      EXPECT_THAT(client.ReceiveAll(), testing::EndsWith("Robot:.")) << line << " " << host;
    }
  }
  const RawConnection client(server_.port());
  client.Send("POST /stop/Robot HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 3\r\n\r\nwhy");
  EXPECT_THAT(client.ReceiveAll(), testing::EndsWith("Robot:why."));
}

TEST_F(HttpServerTest, HandlersSeeOneFormOfAPath) {
  const auto answer = [this](const std::string& line) {
    const RawConnection client(server_.port());
    client.Send(line + " HTTP/1.1\r\nHost: x\r\n\r\n");
    return client.ReceiveAll();
  };
  for (const char* line :
       {"GET /hello/", "GET //hello", "GET http://x/hello", "get /hello?a=/b/"}) {
    EXPECT_THAT(answer(line), testing::EndsWith("hello")) << line;
  }
  for (const char* line : {"GET /Hello", "GET /", "GET http://x", "GET hello"}) {
    EXPECT_THAT(answer(line), HasSubstr("404")) << line;
  }
}

TEST_F(HttpServerTest, AnAddressThatNamesTheHostIsJudgedByThatHost) {
  std::string judged;
  Server judging({.threads = 2, .body_bytes = 100}, Complain);
  judging.JudgeBy(
      [&](const httplib::Request& request) {
        judged = request.get_header_value("Host");
        return Refusal{403, "no"};
      },
      [](const Refusal& refusal, httplib::Response& response) {
        response.status = refusal.status;
      });
  ASSERT_TRUE(judging.Listen("127.0.0.1", 0));
  const RawConnection client(judging.port());
  client.Send("GET http://evil.example:80/hello HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(client.ReceiveAll(), HasSubstr("403"));
  EXPECT_EQ(judged, "evil.example:80");
}

TEST_F(AnyBodyTest, ItIsObeyedWithoutABodyThatDoesNotCome) {
  for (const char* head : {"Content-Length: 3\r\n", "Transfer-Encoding: chunked\r\n"}) {
    const auto began = std::chrono::steady_clock::now();
    EXPECT_THAT(Answer(head), testing::EndsWith("robot:.")) << head;
    EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(4))
        << "as long as others are waited for: " << head;
  }
}

TEST_F(AnyBodyTest, ABodyWithoutEndTakesNoMemory) {
  const std::string chunk = "10000\r\n" + std::string(0x10000, 'x') + "\r\n";
  EXPECT_LT(RawConnection(server_.port())
                .SendForEver("POST /stop/robot HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: "
                             "chunked\r\n\r\n",
                             chunk),
            16U << 20U);
}

// A client that connects and says nothing has its thread for a second where others wait.
TEST_F(HttpServerTest, ManyWhoSayNothingAreDoneWith) {
  std::vector<std::unique_ptr<RawConnection>> silent;
  for (int i = 0; i < 6; ++i) silent.push_back(std::make_unique<RawConnection>(server_.port()));
  EXPECT_EQ(Hello(), 200);
  for (const auto& client : silent) EXPECT_EQ(client->Receive(), "") << "it was hung up on";
}

TEST_F(HttpServerTest, OneAddressDoesNotTakeAllThreads) {
  Server shared({.threads = 4, .waiting = 8, .of_one_address = 3}, Complain);
  shared.Get("/hello", [](const httplib::Request&, httplib::Response& response) {
    response.set_content("hello", "text/plain");
  });
  ASSERT_TRUE(shared.Listen("127.0.0.1", 0));
  std::vector<std::unique_ptr<RawConnection>> silent;
  for (int i = 0; i < 10; ++i) silent.push_back(std::make_unique<RawConnection>(shared.port()));
  httplib::Client other("127.0.0.1", shared.port());
  other.set_interface("127.0.0.2");
  other.set_read_timeout(test::kLongEnough);
  const auto hello = other.Get("/hello");
  ASSERT_TRUE(hello) << httplib::to_string(hello.error());
  EXPECT_EQ(hello->body, "hello");
  for (std::size_t i = 3; i < silent.size(); ++i) {
    EXPECT_EQ(silent[i]->Receive(), "") << "it was hung up on at once";
  }
  silent.clear();
  const auto until = std::chrono::steady_clock::now() + test::kLongEnough;
  int status = 0;
  while (status != 200 && std::chrono::steady_clock::now() < until) {
    const auto again = httplib::Client("127.0.0.1", shared.port()).Get("/hello");
    status = again ? again->status : 0;
  }
  EXPECT_EQ(status, 200) << "who went makes room";
}

TEST(HttpServer, WhoSaysWhatTheyWantIsAnsweredBesideManyAddressesThatSayNothing) {
  Server shared({.threads = 4, .waiting = 2, .of_one_address = 3}, Complain);
  shared.Get("/hello", [](const httplib::Request&, httplib::Response& response) {
    response.set_content("hello", "text/plain");
  });
  ASSERT_TRUE(shared.Listen("127.0.0.1", 0));
  std::vector<std::unique_ptr<RawConnection>> silent;
  for (int i = 0; i < 30; ++i) {
    const std::string address = "127.0.1." + std::to_string(1 + i % 3);
    silent.push_back(std::make_unique<RawConnection>(shared.port(), address));
  }
  for (int i = 0; i < 10; ++i) {
    // Each has an address of its own, which no earlier connection counts for that is still closed.
    const RawConnection asks(shared.port(), "127.0.2." + std::to_string(1 + i));
    asks.Send("GET /hello HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n");
    std::string answer;
    for (std::string more = asks.Receive(); !more.empty(); more = asks.Receive()) answer += more;
    EXPECT_THAT(answer, testing::EndsWith("hello"));
    silent.push_back(std::make_unique<RawConnection>(shared.port(), "127.0.1.1"));
  }
}

// A server whose two threads are taken by clients of 127.0.1.1 that have said what they want.
class TakenThreadsTest : public testing::Test {
 protected:
  void SetUp() override {
    server_.Get("/hello", [](const httplib::Request&, httplib::Response& response) {
      response.set_content("hello", "text/plain");
    });
    server_.Get("/long", [](const httplib::Request&, httplib::Response& response) {
      response.set_content(std::string(kLong, 'x'), "text/plain");
    });
    server_.Post("/length", [](const httplib::Request& request, httplib::Response& response) {
      response.set_content(std::to_string(request.body.size()), "text/plain");
    });
    server_.JudgeBy(
        [this](const httplib::Request&) {
          ++judged_;
          return std::optional<Refusal>();
        },
        [](const Refusal&, httplib::Response&) {});
    ASSERT_TRUE(server_.Listen("127.0.0.1", 0));
  }
  using Clients = std::vector<std::unique_ptr<RawConnection>>;
  Clients Ask(const std::string& request) {
    Clients clients;
    for (int i = 0; i < 2; ++i) {
      clients.push_back(std::make_unique<RawConnection>(server_.port(), "127.0.1.1"));
      clients.back()->Send(request);
    }
    test::Await([&] { return judged_ == 2; }, "both threads to know what is wanted");
    return clients;
  }
  [[nodiscard]] std::string HelloTo(const std::string& address) const {
    const RawConnection client(server_.port(), address);
    client.Send("GET /hello HTTP/1.1\r\nHost: x\r\n\r\n");
    return client.ReceiveAll();
  }
  static constexpr std::size_t kLong = 64U << 20U;
  static constexpr const char* kSlowBody =
      "POST /length HTTP/1.1\r\nHost: x\r\nContent-Length: 90\r\n\r\n{";

  std::atomic<int> judged_{0};
  Server server_{{.threads = 2, .waiting = 8, .body_bytes = 100, .of_one_address = 2}, Complain};
};

// In time they would have been told that their request is no good.
TEST_F(TakenThreadsTest, WhoseBodyDoesNotComeGivesWay) {
  const Clients slow = Ask(kSlowBody);
  EXPECT_THAT(HelloTo("127.0.0.1"), HasSubstr("hello"));
  EXPECT_EQ(slow.front()->ReceiveAll(), "");
}

TEST_F(TakenThreadsTest, WhoDoesNotTakeTheAnswerGivesWay) {
  const Clients slow = Ask("GET /long HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_THAT(HelloTo("127.0.0.1"), HasSubstr("hello"));
  EXPECT_LT(slow[0]->ReceiveAll().size() + slow[1]->ReceiveAll().size(), 2 * kLong);
}

TEST_F(TakenThreadsTest, ItsOwnAddressIsLetInAgain) {
  const Clients slow = Ask(kSlowBody);
  test::Await([&] { return HelloTo("127.0.1.1").find("hello") != std::string::npos; },
              "an answer to the address that has all connections it may have");
  EXPECT_EQ(slow.front()->ReceiveAll(), "");
}

// The kernel takes such an answer whole, and would keep it for who never does.
TEST(HttpServer, NoMoreAnswersAreKeptForOneAddressThanItMayHaveConnections) {
  constexpr std::size_t kAnswer = 400'000;
  Server server({.threads = 2, .waiting = 8, .of_one_address = 3}, Complain);
  server.Get("/", [](const httplib::Request&, httplib::Response& response) {
    response.set_content(std::string(kAnswer, 'x'), "text/plain");
  });
  std::atomic<int> answered{0};
  server.set_logger([&](const httplib::Request&, const httplib::Response&) { ++answered; });
  ASSERT_TRUE(server.Listen("127.0.0.1", 0));
  std::vector<std::unique_ptr<RawConnection>> slow;
  for (int i = 0; i < 5; ++i) {
    slow.push_back(std::make_unique<RawConnection>(server.port(), "127.0.1.1"));
    slow.back()->Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
    test::Await([&] { return answered == i + 1; }, "an answer");
  }
  const RawConnection other(server.port());
  other.Send("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
  EXPECT_GT(other.ReceiveAll().size(), kAnswer);
  EXPECT_LT(slow.front()->ReceiveAll().size(), kAnswer) << "the eldest's is forgotten";
  EXPECT_GT(slow.back()->ReceiveAll().size(), kAnswer);
}

TEST_F(HttpServerTest, APortThatIsTakenIsRefused) {
  Server second{Limits{}, Complain};
  const auto listens = second.Listen("127.0.0.1", server_.port());
  ASSERT_FALSE(listens);
  EXPECT_EQ(listens.error().code, ErrorCode::kUnavailable);
}

}  // namespace
}  // namespace trailcast::http
