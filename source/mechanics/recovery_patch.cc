#include <algorithm>
#include <mechanics/recovery_patch.h>

namespace NMM
{
  namespace internal
  {
    namespace
    {
      constexpr unsigned int n_corners = 3;

      bool
      lies_on_joint(const ManifoldMesh &mesh, const ElementEdge &edge)
      {
        if (edge.curve_set == invalid_index)
          return false;
        const PhysicalMesh &physical_mesh = mesh.physical_mesh();
        for (const unsigned int piece : mesh.curve_set(edge.curve_set))
          if (physical_mesh.curves()[physical_mesh.piece_to_curve()[piece]]
                .role == CurveRole::joint)
            return true;
        return false;
      }
    } // namespace


    RecoveryPatches::RecoveryPatches(const CoverSystem &covers,
                                     const Aggregation &aggregation)
      : covers(&covers)
      , both_sides(covers.n_covers(), false)
      , is_sample(covers.n_covers(), false)
      , cover_elements_begin(covers.n_covers() + 1, 0)
      , element_mark(covers.manifold_mesh().n_elements(), 0)
      , sample_mark(covers.n_covers(), 0)
      , corner_mark(covers.n_covers(), 0)
    {
      const ManifoldMesh &mesh       = covers.manifold_mesh();
      const unsigned int  n_elements = mesh.n_elements();

      // list the elements of each corner cover
      for (unsigned int e = 0; e < n_elements; ++e)
        for (unsigned int i = 0; i < n_corners; ++i)
          ++cover_elements_begin[covers.covers(e)[i] + 1];
      for (unsigned int k = 0; k < covers.n_covers(); ++k)
        cover_elements_begin[k + 1] += cover_elements_begin[k];
      cover_elements.resize(n_corners * n_elements);
      std::vector<unsigned int> next(cover_elements_begin.begin(),
                                     cover_elements_begin.end() - 1);
      for (unsigned int e = 0; e < n_elements; ++e)
        for (unsigned int i = 0; i < n_corners; ++i)
          cover_elements[next[covers.covers(e)[i]]++] = e;

      for (unsigned int e = 0; e < n_elements; ++e)
        if (mesh.is_whole(e))
          for (const unsigned int k : covers.covers(e))
            is_sample[k] =
              aggregation.is_free.empty() || aggregation.is_free[k];

      for (unsigned int e = 0; e < n_elements; ++e)
        for (const ElementEdge &edge : mesh.edges(e))
          if (edge.neighbor != invalid_index && lies_on_joint(mesh, edge))
          {
            const auto there = covers.covers(edge.neighbor);
            for (unsigned int i = 0; i < n_corners; ++i)
            {
              const unsigned int k = covers.covers(e)[i];
              if (std::find(there.begin(), there.end(), k) != there.end())
                both_sides[k] = true;
            }
          }
    }


    bool
    RecoveryPatches::sees_both_sides(const unsigned int cover) const
    {
      return both_sides[cover];
    }


    void
    RecoveryPatches::add_element(const unsigned int element)
    {
      if (element_mark[element] == patch_number)
        return;
      element_mark[element] = patch_number;
      patch_elements.push_back(element);
      if (!covers->manifold_mesh().is_whole(element))
        patch_cut_elements.push_back(element);
      for (const unsigned int k : covers->covers(element))
        if (sample_mark[k] != patch_number)
        {
          sample_mark[k] = patch_number;
          if (is_sample[k])
            patch_samples.push_back(k);
        }
    }


    void
    RecoveryPatches::start(const unsigned int cover)
    {
      ++patch_number;
      patch_elements.clear();
      patch_cut_elements.clear();
      patch_samples.clear();
      ring_begin         = 0;
      corner_mark[cover] = patch_number;
      for (unsigned int i = cover_elements_begin[cover];
           i < cover_elements_begin[cover + 1];
           ++i)
        add_element(cover_elements[i]);
    }


    bool
    RecoveryPatches::widen()
    {
      const std::size_t ring_end = patch_elements.size();
      for (std::size_t e = ring_begin; e < ring_end; ++e)
        for (unsigned int i = 0; i < n_corners; ++i)
        {
          const unsigned int k = covers->covers(patch_elements[e])[i];
          if (corner_mark[k] == patch_number || both_sides[k])
            continue;
          corner_mark[k] = patch_number;
          for (unsigned int j = cover_elements_begin[k];
               j < cover_elements_begin[k + 1];
               ++j)
            add_element(cover_elements[j]);
        }
      ring_begin = ring_end;
      return patch_elements.size() > ring_end;
    }


    const std::vector<unsigned int> &
    RecoveryPatches::samples() const
    {
      return patch_samples;
    }


    const std::vector<unsigned int> &
    RecoveryPatches::cut_elements() const
    {
      return patch_cut_elements;
    }
  } // namespace internal
} // namespace NMM
