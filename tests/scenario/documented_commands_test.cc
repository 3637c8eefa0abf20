// The commands that documents show are understood by the programs: each command and each flag is
// one that the program itself explains.
#include <map>
#include <set>
#include <sstream>

#include "tests/scenario/programs.h"
#include "tests/support/documents.h"

namespace trailcast::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

struct Shown {
  std::string where;
  std::vector<std::string> words;  // the program's name first
};

bool IsProgram(const std::string& word) {
  static const std::set<std::string> kPrograms{"trailcast", "trailcast-agent", "trailcast-console",
                                               "trailcast-server", "trailcast-vda5050"};
  return kPrograms.contains(word);
}

// The commands of one line of shell: where a program's name is at the beginning, or after one of
// these. A comment, a pipe and a redirection end them.
std::vector<std::vector<std::string>> CommandsIn(const std::string& line) {
  static const std::set<std::string> kBefore{"$", "sudo", "-E", "&&", "||", "|", ";", "do"};
  static const std::set<std::string> kEnds{"&&", "||", "|", "&", ";", ">", ">>", "2>&1", "do"};
  std::vector<std::vector<std::string>> commands;
  std::istringstream in(line);
  std::string word;
  bool begins = true;
  bool command = false;
  while (in >> word && !word.starts_with('#')) {
    if (begins && IsProgram(word)) {
      commands.push_back({word});
      command = true;
    } else if (kEnds.contains(word)) {
      command = false;
    } else if (command) {
      commands.back().push_back(word.ends_with(';') ? word.substr(0, word.size() - 1) : word);
      command = !word.ends_with(';');
    }
    const bool variable = word.find('=') != std::string::npos && !word.starts_with('-');
    begins = kBefore.contains(word) || word.ends_with(';') || (begins && variable);
  }
  return commands;
}

std::vector<Shown> CommandsOf(const Document& document) {
  std::vector<Shown> shown;
  std::string text;
  for (const DocumentLine& line : document.lines) {
    if (line.kind != LineKind::kCode) {
      text.clear();
      continue;
    }
    text += line.text;
    if (text.ends_with('\\')) {
      text.pop_back();
      continue;
    }
    for (auto& words : CommandsIn(text)) shown.push_back({document.Where(line.number), words});
    text.clear();
  }
  return shown;
}

class DocumentedCommands : public ProgramsTest {
 protected:
  // This is what a program explains of itself, or of a command of its own. It is empty for a
  // command that does not exist.
  struct Explained {
    std::string flags;     // with what each is for
    std::string commands;  // those of its own, a line each
  };
  const Explained& Explain(const std::vector<std::string>& command) {
    std::string key;
    for (const std::string& word : command) key += word + " ";
    const auto [explained, is_new] = explained_.try_emplace(key);
    if (is_new) {
      // With --help-all it explains those of its commands as well.
      const std::string all = Ask(command, "--help-all");
      explained->second.flags = all.substr(0, all.find(kCommands));
      const std::string brief = Ask(command, "--help");
      const std::size_t list = brief.find(kCommands);
      if (list != std::string::npos) explained->second.commands = brief.substr(list);
    }
    return explained->second;
  }
  std::string Ask(const std::vector<std::string>& command, const std::string& what) {
    std::vector<std::string> argv{ProgramsDir() + "/" + command.front()};
    argv.insert(argv.end(), command.begin() + 1, command.end());
    argv.push_back(what);
    Process process(argv, Path("help.log"));
    const Ended ended = End(process);
    return ended.status == 0 ? ended.output : "";
  }

  // The output of a script that has loaded a shell's completion.
  std::string Complete(std::vector<std::string> shell, const std::string& suffix,
                       const std::string& script, const std::string& before = "") {
    shell.push_back(before + "source " + SourceDir() + "/config/completion/trailcast." + suffix +
                    "; export PATH=" + ProgramsDir() + ":\"$PATH\"; " + script);
    Process process(shell, Path("completed"));
    return End(process).output;
  }

  static bool HasCommand(const std::string& commands, const std::string& name) {
    return commands.find("\n  " + name + " ") != std::string::npos;
  }
  // A flag begins a line where it is explained, and is somewhere in an example.
  static bool HasFlag(const std::string& flags, const std::string& flag) {
    const std::string line = "\n  " + flag;
    for (std::size_t at = flags.find(line); at != std::string::npos;
         at = flags.find(line, at + 1)) {
      const std::size_t end = at + line.size();
      if (end == flags.size() || flags[end] == ' ' || flags[end] == '\n') return true;
    }
    return flag == "--help";
  }

  // Returns what is wrong with it, or an empty text if nothing is.
  std::string Wrong(const std::vector<std::string>& words) {
    std::vector<std::string> command{words.front()};
    Explained explained = Explain(command);
    for (std::size_t i = 1; i < words.size(); ++i) {
      const std::string word = words[i].substr(0, words[i].find('='));
      if (word.starts_with("--") && !HasFlag(explained.flags, word)) return "there is no " + word;
      if (HasCommand(explained.commands, word)) {
        command.push_back(word);
        const Explained& own = Explain(command);
        explained = {explained.flags + own.flags, own.commands};
      } else if (i == 1 && !word.starts_with('-') && !explained.commands.empty()) {
        return "there is no command " + word;
      }
    }
    return "";
  }

 private:
  static constexpr const char* kCommands = "Subcommands:";
  std::map<std::string, Explained> explained_;
};

TEST_F(DocumentedCommands, AreUnderstoodByThePrograms) {
  int commands = 0;
  std::vector<std::string> wrong;
  for (const Document& document : ReadDocuments()) {
    for (const Shown& shown : CommandsOf(document)) {
      ++commands;
      const std::string what = Wrong(shown.words);
      if (!what.empty()) wrong.push_back(shown.where + ": " + what);
    }
  }
  EXPECT_THAT(wrong, IsEmpty());
  EXPECT_GT(commands, 150);
}

TEST_F(DocumentedCommands, WhatIsNotThereIsFound) {
  EXPECT_EQ(Wrong({"trailcast", "routes", "--long"}), "");
  EXPECT_EQ(Wrong({"trailcast", "routes", "--longer"}), "there is no --longer");
  EXPECT_EQ(Wrong({"trailcast", "drive", "robot1"}), "there is no command drive");
  EXPECT_EQ(Wrong({"trailcast", "keys", "add", "--role", "scout", "robot1"}), "");
  EXPECT_EQ(Wrong({"trailcast", "keys", "list", "--role", "scout"}), "there is no --role");
}

TEST_F(DocumentedCommands, ManPagesHaveEveryCommandAndItsFlags) {
  Process script({SourceDir() + "/config/cmake/man_page.sh", ProgramsDir() + "/trailcast"},
                 Path("page.1"));
  const Ended page = End(script);
  ASSERT_EQ(page.status, 0) << page.output;
  EXPECT_THAT(page.output,
              AllOf(HasSubstr(".TH TRAILCAST 1 "), HasSubstr(".SH \"trailcast routes\""),
                    HasSubstr(".SH \"trailcast keys add\""), HasSubstr(".B \\-\\-near\\-site X,Y"),
                    HasSubstr(".SS \"Examples\"")));
}

TEST_F(DocumentedCommands, BashCompletesCommandsFlagsAndValues) {
  const auto completed = [&](const std::string& words) {
    return Complete({"/bin/bash", "-c"}, "bash",
                    "COMP_WORDS=(" + words + "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); " +
                        "_trailcast; echo ${COMPREPLY[*]}");
  };
  EXPECT_EQ(completed("trailcast rou"), "routes\n");
  EXPECT_EQ(completed("trailcast routes --near"), "--near-site --near-gps\n");
  EXPECT_EQ(completed("trailcast-agent replay --start ''"), "left beginning anywhere\n");
  EXPECT_THAT(completed("trailcast --domain 7 keys ''"), HasSubstr("revoke"));
}

TEST_F(DocumentedCommands, FishCompletesCommandsFlagsAndValues) {
  const auto completed = [&](const std::string& line) {
    return Complete({"/usr/bin/fish", "--no-config", "-c"}, "fish", "complete -C '" + line + "'");
  };
  EXPECT_EQ(completed("trailcast rou"), "routes\tList the routes that a route server keeps\n");
  EXPECT_EQ(completed("trailcast routes --near"), "--near-gps\n--near-site\n");
  EXPECT_EQ(completed("trailcast-agent replay --start "), "anywhere\nbeginning\nleft\n");
  EXPECT_THAT(completed("trailcast --domain 7 keys "), HasSubstr("revoke\t"));
}

TEST_F(DocumentedCommands, ZshCompletesCommandsFlagsAndValues) {
  // Outside of its line editor zsh cannot complete, so this prints all that it would choose from.
  const auto offered = [&](const std::string& words) {
    return Complete({"/usr/bin/zsh", "-f", "-c"}, "zsh",
                    "words=(" + words + "); CURRENT=$#words; _trailcast",
                    "compadd() { print -l -- ${(P)2} }; _describe() { compadd -a $2 }; "
                    "words=(true); CURRENT=1; _files() { }; ");
  };
  EXPECT_THAT(offered("trailcast rou"), HasSubstr("routes:List the routes that a route server"));
  EXPECT_THAT(offered("trailcast routes --near"), HasSubstr("\n--near-site\n--near-gps\n"));
  EXPECT_EQ(offered("trailcast-agent replay --start ''"), "left\nbeginning\nanywhere\n");
  EXPECT_THAT(offered("trailcast --domain 7 keys ''"), HasSubstr("revoke:"));
}

TEST_F(DocumentedCommands, AreFoundInALineOfShell) {
  EXPECT_THAT(
      CommandsIn("A=b trailcast routes --json | jq . && trailcast fleet  # trailcast where"),
      ElementsAre(ElementsAre("trailcast", "routes", "--json"), ElementsAre("trailcast", "fleet")));
  EXPECT_THAT(CommandsIn("docker exec console trailcast users"), IsEmpty());
  EXPECT_THAT(CommandsIn("for i in 1 2; do trailcast keys add x-$i; done"), SizeIs(1));
}

}  // namespace
}  // namespace trailcast::test
