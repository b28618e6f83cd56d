#ifndef nmm_source_contact_corner_rules_h
#define nmm_source_contact_corner_rules_h

#include <nmm/base/types.h>

#include <cmath>

/**
 * What is decided at corners. Along a face, contact has no choice: the nearest point of the other
 * face is unique, and so is its normal. Where a face ends, something has to say which face a
 * point belongs to, and for how much of the contact it stands. All numbers that do so are here,
 * each with what it means, why it is needed, and a test that fails without it (named in
 * parentheses as test executable: test). Lengths are parts of what is said; angles are given by
 * "facing", minus the product of the unit normals of both faces: 1 if they lie on each other, 0 if
 * they stand at a right angle.
 */
namespace NMM
{
  namespace internal
  {
    namespace CornerRules
    {
