#ifndef nmm_tests_support_n_samples_h
#define nmm_tests_support_n_samples_h

/**
 * How many samples a randomised test takes: @p n in Release, where it looks for what is
 * rare; a tenth of them in Debug, which is five to ten times slower and where it need
 * only pass the assertions.
 */
constexpr unsigned int
n_samples(const unsigned int n)
{
#ifdef DEBUG
  return (n + 9) / 10;
#else
  return n;
#endif
}

#endif
