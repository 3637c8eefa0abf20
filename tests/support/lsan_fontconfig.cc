// Fontconfig keeps what it found of the fonts until the process ends, out of the sanitizer's sight.
#if defined(TRAILCAST_ASAN)
extern "C" const char* __lsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "leak:libfontconfig\n";
}
#endif
