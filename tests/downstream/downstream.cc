#include <nmm/base/exceptions.h>

#include <iostream>

int
main()
{
  const NMM::InputError error("nothing", NMM::to_string({1., 2.}), "go on");
  std::cout << error.message() << std::endl;
  return error.message() == "nothing, at (1, 2): go on" ? 0 : 1;
}
