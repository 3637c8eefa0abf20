// libpqxx 6.4 keeps the answer to the statement that finds a connection lost: 2 kB each time.
#if defined(TRAILCAST_ASAN)
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libpqxx\n";
}
#endif
