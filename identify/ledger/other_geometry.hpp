#pragma once
/// What else x of a base-driven record may be, and against what friction may act.
///
/// As stated, x and friction are those against the ground: m x'' + c x' + k (x - y) + F0 sgn x' = 0. A sensor
/// between mass and base measures z = x - y, and friction, damper and spring may all ride on the base: m z'' + c z'
/// + k z + F0 sgn z' = -m y''. Either makes friction, spring and sensors seem to depart together. The readings of
/// the record under the other equation, with its own drive, are a record that the ledger can test.
///
/// At one frequency the drive -m y'' is k y with another gain, so pairs need several. Pairs without phases are not
/// converted.

#include <functional>
#include <string>
#include <vector>

#include "identify/ledger/ledger.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct OtherGeometry {
  std::string words;  ///< "x is measured from the base, and friction acts against the base"
  Record record;      ///< x against what friction acts on, and the drive of this motion
};

/// The other geometries that this record can be converted to; none without mass and stiffness, without a base that
/// was measured, or beside a force. Cost: linear.
[[nodiscard]] std::vector<OtherGeometry> other_geometries(const Record& record, const KnownConstants& constants);

/// Where no joint estimate describes a record as stated, and one describes it in another geometry, beside which
/// nothing departs: names that geometry. Histories tell it from all else, so that what is charged is taken back; a
/// dozen steady states may fit it by chance, and both are left. `test`: the ledger of another record.
void explain_by_geometry(const Record& record, const KnownConstants& constants,
                         const std::function<Ledger(const Record&)>& test, Ledger& ledger);

}  // namespace dualdamp::identify
