#include <fmt/format.h>
#include <httplib.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <future>
#include <memory>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

#include "services/route/route.h"
#include "tests/bench/console_bench.h"
#include "tests/bench/console_script.h"
#include "tests/scenario/console/webdriver.h"

namespace trailcast::bench {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test::Browser;
using test::Process;
using Json = Browser::Json;

constexpr int kMorePages = 8;
constexpr std::uint32_t kMostListed = 40;  // pages of routes
constexpr int kHeapsOfADay = 24;

double Since_s(steady_clock::time_point then) {
  return std::chrono::duration<double>(steady_clock::now() - then).count();
}

// Returns the time of all of the process's threads.
double CpuSeconds(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/stat", pid));
  const std::string line{std::istreambuf_iterator<char>(file), {}};
  std::istringstream words(line.substr(line.rfind(')') + 2));
  std::string word;
  constexpr int kBeforeUserTime = 11;
  for (int i = 0; i < kBeforeUserTime; ++i) words >> word;
  double user = 0.0;
  double system = 0.0;
  words >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double ResidentMb(pid_t pid) {
  std::ifstream file(fmt::format("/proc/{}/statm", pid));
  double all = 0.0;
  double resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

// This is what the process's host has received and sent so far.
struct Radio {
  double in_bytes = 0.0;
  double in_packets = 0.0;
  double out_bytes = 0.0;
  double out_packets = 0.0;
};
Radio RadioOf(pid_t pid, const std::string& interface) {
  std::ifstream file(fmt::format("/proc/{}/net/dev", pid));
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string name;
    Radio radio;
    double other = 0.0;
    words >> name;
    if (name != interface + ":") continue;
    words >> radio.in_bytes >> radio.in_packets;
    for (int i = 0; i < 6; ++i) words >> other;
    words >> radio.out_bytes >> radio.out_packets;
    return radio;
  }
  return {};
}

class Look {
 public:
  explicit Look(const ConsoleOptions& options) : options_(options) {}

  Result<void> Run() {
    if (auto began = StartConsole(); !began) return began;
    Cost("nobody looks");
    {
      std::vector<std::unique_ptr<Listener>> pages;
      for (int i = 0; i < kMorePages; ++i) pages.push_back(std::make_unique<Listener>(port_));
      Cost(fmt::format("{} streams", kMorePages));
    }
    if (!test::WaitUntil([&] { return Metric("trailcast_console_streams") == 0.0; }))
      return Fail(ErrorCode::kUnavailable, "streams stay");
    if (auto looked = Pages(); !looked) return looked;
    if (options_.day > 0) return Day();
    return {};
  }

 private:
  // Reads a stream of events and forgets it.
  class Listener {
   public:
    explicit Listener(int port) : client_("localhost", port) {
      thread_ = std::thread([this] {
        (void)client_.Get("/api/events", [this](const char*, std::size_t) { return !over_; });
      });
    }
    ~Listener() {
      over_ = true;
      thread_.join();
    }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

   private:
    httplib::Client client_;
    std::atomic<bool> over_ = false;
    std::thread thread_;
  };

  static tl::unexpected<Error> Failed(const std::string& why) {
    return Fail(ErrorCode::kUnavailable, "{}", why);
  }
  [[nodiscard]] std::string Url(const std::string& page) const {
    return fmt::format("http://localhost:{}/#{}", port_, page);
  }
  // -1: there is none such.
  [[nodiscard]] double Metric(const std::string& name) const {
    httplib::Client client("localhost", port_);
    const auto got = client.Get("/metrics");
    if (!got) return -1.0;
    const auto at = got->body.find("\n" + name + " ");
    return at == std::string::npos ? -1.0 : std::stod(got->body.substr(at + name.size() + 2));
  }

  Result<void> StartConsole() {
    console_ = std::make_unique<Process>(
        std::vector<std::string>{(options_.programs / "trailcast-console").string(),
                                 "--network-interface", options_.network_interface, "--http-port",
                                 "0"},
        options_.folder / "console.log");
    const std::string said = "http://localhost:";
    if (!console_->WaitForOutput(said)) return Failed(console_->output());
    const std::string output = console_->output();
    port_ = std::stoi(output.substr(output.find(said) + said.size()));
    const double moving = 0.9 * options_.robots;
    if (!test::WaitUntil([&] { return Metric("trailcast_robots{state=\"driving\"}") >= moving; })) {
      return Failed("the console does not hear all robots:\n" + console_->output());
    }
    return SendAll();
  }
  // Each is sent along its route.
  Result<void> SendAll() const {
    constexpr std::uint32_t kAtOnce = 10;
    std::vector<std::future<int>> sent;
    for (std::uint32_t first = 0; first < kAtOnce; ++first) {
      sent.push_back(std::async(std::launch::async, [this, first] {
        httplib::Client client("localhost", port_);
        client.set_read_timeout(20);
        int failed = 0;
        for (std::uint32_t n = first; n < options_.robots; n += kAtOnce) {
          const auto reply = client.Post(fmt::format("/api/robots/robot{:03}/missions", n),
                                         fmt::format("{{\"orders\": \"follow aisle-{:04}\"}}", n),
                                         "application/json");
          failed += reply && reply->status == 200 ? 0 : 1;
        }
        return failed;
      }));
    }
    int failed = 0;
    for (auto& each : sent) failed += each.get();
    if (failed > 0) return Failed(fmt::format("{} robots took no mission", failed));
    return {};
  }

  void Cost(const std::string& what) {
    const double console_s = CpuSeconds(console_->pid());
    const double server_s = CpuSeconds(options_.server);
    const Radio console = RadioOf(console_->pid(), options_.network_interface);
    const Radio server = RadioOf(options_.server, options_.network_interface);
    const double told = Metric("trailcast_console_stream_bytes_total");
    const auto began = steady_clock::now();
    std::this_thread::sleep_for(std::chrono::seconds(options_.seconds));
    const double s = Since_s(began);
    const Radio console_now = RadioOf(console_->pid(), options_.network_interface);
    const Radio server_now = RadioOf(options_.server, options_.network_interface);
    fmt::print(
        "{}: console {:.1f} % of a core, {:.1f} MB; {:.0f} streams, {:.1f} kB/s; sends {:.1f} "
        "packets/s, "
        "{:.2f} kB/s, receives {:.1f}, {:.2f}; server {:.1f} %, {:.1f} MB, sends {:.1f}, {:.2f}\n",
        what, 100.0 * (CpuSeconds(console_->pid()) - console_s) / s, ResidentMb(console_->pid()),
        Metric("trailcast_console_streams"),
        (Metric("trailcast_console_stream_bytes_total") - told) / s / 1000.0,
        (console_now.out_packets - console.out_packets) / s,
        (console_now.out_bytes - console.out_bytes) / s / 1000.0,
        (console_now.in_packets - console.in_packets) / s,
        (console_now.in_bytes - console.in_bytes) / s / 1000.0,
        100.0 * (CpuSeconds(options_.server) - server_s) / s, ResidentMb(options_.server),
        (server_now.out_packets - server.out_packets) / s,
        (server_now.out_bytes - server.out_bytes) / s / 1000.0);
    std::fflush(stdout);
  }

  Result<std::unique_ptr<Browser>> OpenBrowser(const std::string& scripts) const {
    const auto folder = options_.folder / fmt::format("browser{}", Since_s({}));
    std::filesystem::create_directory(folder);
    auto browser = std::make_unique<Browser>(folder);
    if (!browser->runs()) return Failed(browser->log());
    browser->Look(1280, 900);
    (void)browser->DevTools("Performance.enable");
    (void)browser->DevTools("Page.enable");
    (void)browser->DevTools("Page.addScriptToEvaluateOnNewDocument", {{"source", scripts}});
    return browser;
  }

  [[nodiscard]] double PageMetric(const std::string& name) {
    const Json metrics = browser_->DevTools("Performance.getMetrics");
    for (const auto& metric : metrics.value("metrics", Json::array())) {
      if (metric["name"] == name) return metric["value"];
    }
    return 0.0;
  }
  [[nodiscard]] double HeapMb() {
    (void)browser_->DevTools("HeapProfiler.collectGarbage");
    return PageMetric("JSHeapUsedSize") / 1e6;
  }

  void Frames(const std::string& what, bool scrolls = false) {
    const double busy_s = PageMetric("TaskDuration");
    const auto began = steady_clock::now();
    (void)browser_->Run(fmt::format("bench.start({})", scrolls));
    if (scrolls) {
      std::this_thread::sleep_for(std::chrono::seconds(options_.seconds));
    } else {
      Cost(what);
    }
    const double busy = (PageMetric("TaskDuration") - busy_s) / Since_s(began);
    const Json is = browser_->Run("return bench.stop()");
    fmt::print(
        "{}{}: {} frames, median {:.1f} ms, p99 {:.1f}, longest {:.1f}, {} over 50 ms; {} tasks "
        "over 50 ms, the longest {:.0f}; the page's thread busy {:.1f} %; {} elements; heap "
        "{:.1f} MB\n",
        what, scrolls ? ", scrolled" : "", is["frames"].get<int>(), is["median"].get<double>(),
        is["p99"].get<double>(), is["longest"].get<double>(), is["late"].get<int>(),
        is["tasks"].get<int>(), is["longest_task"].get<double>(), 100.0 * busy,
        is["elements"].get<int>(), HeapMb());
    std::fflush(stdout);
  }

  // In ms; 0: never.
  double Shown() {
    double ms = 0.0;
    (void)test::WaitUntil([&] {
      const Json shown = browser_->Run("return bench.shown()");
      ms = shown.is_number() ? shown.get<double>() : 0.0;
      return ms > 0.0;
    });
    return ms;
  }

  Result<void> Pages() {
    auto browser = OpenBrowser(kBenchScript);
    if (!browser) return tl::unexpected(browser.error());
    browser_ = *std::move(browser);
    browser_->Open("about:blank");
    Frames("an empty page");
    for (const std::string page : {"fleet", "routes", "history"}) {
      browser_->Open("about:blank");
      browser_->Open(Url(page));
      (void)browser_->Run(fmt::format("bench.watch('{}', {})", page, options_.robots));
      const Json since = browser_->Run("return performance.now()");
      const double opened = Shown();
      if (opened <= 0.0) return Failed(page + " does not show");
      fmt::print("{} shows at most {:.0f} ms after it is opened\n", page,
                 since.get<double>() + opened);
      Frames(page);
      Frames(page, true);
      browser_->Screenshot(options_.folder / (page + ".png"));
    }
    for (const std::string page : {"fleet", "routes", "history", "fleet"}) {
      (void)browser_->Run(fmt::format("bench.go('{}', {})", page, options_.robots));
      fmt::print("to {}: {:.0f} ms\n", page, Shown());
    }
    return List();
  }

  // A name is typed, and all pages of routes are asked for, one after the other.
  Result<void> List() {
    browser_->Open("about:blank");
    browser_->Open(Url("routes"));
    (void)browser_->Run("bench.watch('routes')");
    (void)Shown();
    const std::uint32_t middle = options_.routes / 2;
    (void)browser_->Run(fmt::format("bench.type('[name=prefix]', 'aisle-{:04}')", middle));
    fmt::print("a name is typed: {:.0f} ms after its last letter the route is there\n", Shown());
    browser_->Open("about:blank");
    browser_->Open(Url("routes"));
    (void)browser_->Run("bench.watch('routes')");
    (void)Shown();
    constexpr std::uint32_t kPage = 50;
    const auto began = steady_clock::now();
    const std::uint32_t pages = std::min(options_.routes / kPage, kMostListed) - 1;
    (void)browser_->Run(fmt::format("bench.more({})", pages - 1));
    if (Shown() <= 0.0) return Failed("not all routes are listed");
    fmt::print("{} pages of routes more: {:.0f} ms each\n", pages, 1000.0 * Since_s(began) / pages);
    Frames("all routes");
    Frames("all routes", true);
    browser_->Screenshot(options_.folder / "all.png");
    browser_.reset();
    return {};
  }

  // Returns what a console says within a minute.
  Result<Json> Record() const {
    constexpr std::size_t kChanges = 300;
    std::string text;
    std::size_t events = 0;
    httplib::Client client("localhost", port_);
    client.set_read_timeout(20);
    (void)client.Get("/api/events", [&](const char* bytes, std::size_t count) {
      text.append(bytes, count);
      for (std::size_t at = text.size() - count; at < text.size(); ++at) {
        events += at > 0 && text[at] == '\n' && text[at - 1] == '\n' ? 1 : 0;
      }
      return events < kChanges + 1;
    });
    Json said{{"state", ""}, {"changes", Json::array()}, {"routes", Json::array()}};
    std::istringstream lines(text);
    std::string name;
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("event: ", 0) == 0) name = line.substr(7);
      if (line.rfind("data: ", 0) != 0) continue;
      if (name == "state") said["state"] = line.substr(6);
      if (name == "change") said["changes"].push_back(line.substr(6));
    }
    if (said["changes"].size() < kChanges - 1) return Failed("the console says too little");
    for (std::uint32_t n = 0; n < options_.routes; ++n) {
      said["routes"].push_back(ConsoleRoute(n, 0).key.route.value());
    }
    return said;
  }

  Result<void> Day() {
    const auto said = Record();
    if (!said) return tl::unexpected(said.error());
    auto browser = OpenBrowser(
        fmt::format("window.said = {};\n{}\n{}", said->dump(), kReplayScript, kBenchScript));
    if (!browser) return tl::unexpected(browser.error());
    browser_ = *std::move(browser);
    browser_->Open(Url("fleet"));
    (void)browser_->Run("replay.begin()");
    (void)browser_->Run(fmt::format("bench.watch('fleet', {})", options_.robots));
    if (Shown() <= 0.0) return Failed("the page does not show what it is told");
    const auto began = steady_clock::now();
    const std::uint32_t each = options_.day / kHeapsOfADay;
    for (int part = 0; part <= kHeapsOfADay; ++part) {
      const Json at = browser_->Run("return replay.at()");
      fmt::print(
          "{} changes told, {} drawn, {:.0f} s: heap {:.2f} MB, {:.0f} nodes, {:.0f} listeners; "
          "console {:.1f} MB\n",
          at["told"].get<int>(), at["drawn"].get<int>(), Since_s(began), HeapMb(),
          PageMetric("Nodes"), PageMetric("JSEventListeners"), ResidentMb(console_->pid()));
      std::fflush(stdout);
      if (part == kHeapsOfADay) break;
      (void)browser_->Run(fmt::format("replay.run({}); return 0", each));
      // Each question leaves some bytes of Chromium's own in the page's heap.
      const auto until = steady_clock::now() + std::chrono::hours(1);
      bool over = false;
      while (!over && steady_clock::now() < until) {
        std::this_thread::sleep_for(std::chrono::seconds(5));
        const Json now = browser_->Run("return replay.at().over");
        over = now.is_boolean() && now.get<bool>();
      }
      if (!over) return Failed("the page does not keep up");
    }
    browser_.reset();
    return {};
  }

  const ConsoleOptions& options_;
  std::unique_ptr<Process> console_;
  int port_ = 0;
  std::unique_ptr<Browser> browser_;
};

}  // namespace

Result<void> MeasureConsole(const ConsoleOptions& options) { return Look(options).Run(); }

}  // namespace trailcast::bench
