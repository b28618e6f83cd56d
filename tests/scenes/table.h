#ifndef nmm_tests_scenes_table_h
#define nmm_tests_scenes_table_h

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

/// The columns of a table in CSV, as text; lines that begin with # are left out.
inline std::map<std::string, std::vector<std::string>>
read_columns(const std::string &file)
{
  std::ifstream                                   in(file);
  std::vector<std::string>                        names;
  std::map<std::string, std::vector<std::string>> columns;
  for (std::string line; std::getline(in, line);)
  {
    if (line.empty() || line.front() == '#')
      continue;
    std::istringstream       text(line);
    std::vector<std::string> cells;
    for (std::string cell; std::getline(text, cell, ',');)
      cells.push_back(cell);
    if (names.empty())
      names = cells;
    else
      for (unsigned int i = 0; i < cells.size() && i < names.size(); ++i)
        columns[names[i]].push_back(cells[i]);
  }
  return columns;
}

#endif
