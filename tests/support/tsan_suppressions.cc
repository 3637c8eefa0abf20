// Debian's libddsc is not built with ThreadSanitizer, which therefore does not see the atomics that
// order its threads, and reports them as races. GDAL, which OpenCV's codecs bring along, takes two
// of its own locks in either order while one thread starts it. Found by the sanitizer by this name.
#if defined(__SANITIZE_THREAD__)
extern "C" const char* __tsan_default_suppressions();   // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __tsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier)
  return "called_from_lib:libddsc.so\nrace:libddsc.so\ndeadlock:libgdal.so\n";
}
#endif
