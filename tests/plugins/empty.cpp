// A shared library that exports no law.
extern "C" __attribute__((visibility("default"))) int no_law() { return 0; }
