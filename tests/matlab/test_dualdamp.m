% The functions of matlab/ under Octave or MATLAB: the numbers of the program by every way, and its errors.
% usage: DUALDAMP=PROGRAM octave-cli tests/matlab/test_dualdamp.m ROOT
call = argv();
root = call{end};
addpath(fullfile(root, 'matlab'));

scenario.system = struct('mass', '1 kg', 'stiffness', '100 N/m', 'damping', 4, 'friction', struct('law', 'coulomb', 'kinetic', '2 N'));
scenario.excitation = struct('type', 'base_harmonic', 'amplitude', '0.1 m', 'frequency', '10 rad/s');
scenario.analysis = struct('type', 'steady_state');
found = dualdamp_run(scenario);
% Closed form of the slide without stops (Den Hartog): within 1e-3 of x = Y/(2 zeta) - 4 F0/(pi c w).
assert(found.result.amplitude, 0.25 - 4 * 2 / (pi * 4 * 10), 1e-3);
assert(found.status, 0);
assert(numel(found.tables.orbit.t), 721);

changed = dualdamp_run(scenario, 'changes', {'system.friction.kinetic=1 N'});
assert(changed.result.amplitude > found.result.amplitude);

out = tempname();
curve = dualdamp_run(fullfile(root, 'scenarios/examples/xy_curve.yaml'), 'out', out);
assert(numel(curve.result.points), 91);
assert([curve.result.points.x]', curve.tables.curve.x, -2 * eps);  % Octave's jsondecode may miss the last bit
assert(exist(fullfile(out, 'report.html'), 'file') == 2);
rmdir_confirm = confirm_recursive_rmdir(false);
rmdir(out, 's');
confirm_recursive_rmdir(rmdir_confirm);

rig = {'mass', '1.042 kg', 'stiffness', '1568 N/m', 'frequency', '6.17 Hz'};
from_file = dualdamp_identify(fullfile(root, 'scenarios/examples/my_rig.csv'), rig{:});
data = struct('Y', [4.5, 5, 5.5, 6, 6.5] * 1e-3, 'x', [4.7, 7.21, 9.76, 12.25, 14.82] * 1e-3);
from_arrays = dualdamp_identify(data, rig{:});
assert(from_arrays.result.answer.zeta, from_file.result.answer.zeta, -1e-9);
one = dualdamp_identify(data, rig{:}, 'methods', {'resonance_least_squares'});
assert(numel(one.result.estimates), 1);
by_name = dualdamp_identify(data, rig{:}, 'methods', 'resonance_least_squares');
assert(by_name.result.estimates.zeta, one.result.estimates.zeta);
by_text = dualdamp_run(scenario, 'changes', 'system.friction.kinetic=1 N');
assert(by_text.result.amplitude, changed.result.amplitude);

function refused(work, identifier, words)
  try
    work();
  catch fault
    assert(fault.identifier, identifier);
    assert(~isempty(strfind(fault.message, words)), fault.message);
    return;
  end
  error('nothing was refused, expected %s', identifier);
end

bad = scenario;
bad.system.mass = '-1 kg';
refused(@() dualdamp_run(bad), 'dualdamp:invalidScenario', 'system.mass');
undamped = scenario;
undamped.system = struct('mass', 1, 'stiffness', 100, 'damping', 0);
refused(@() dualdamp_run(undamped), 'dualdamp:numericalFailure', 'error');
refused(@() dualdamp_run(scenario, 'program', '/nowhere/dualdamp'), 'dualdamp:program', 'nowhere');
refused(@() dualdamp_run(scenario, 'chagnes', {}), 'dualdamp:usage', 'there are: changes');
refused(@() dualdamp_identify(struct('Y', [1, 2], 'x', 1), rig{:}), 'dualdamp:usage', 'differ in length');
refused(@() dualdamp_identify(struct('Y', data.Y, 'x', data.x + 1i), rig{:}), 'dualdamp:usage', 'column x holds no real numbers');

% Complex numbers lose their imaginary part on the way, and several numbers would be read as one: 12 for [1, 2].
curve = scenario;
curve.excitation = struct('type', 'base_harmonic', 'frequency', '10 rad/s');
curve.analysis = struct('type', 'xy_curve', 'amplitudes', [0.1, 0.2 + 2i]);
refused(@() dualdamp_run(curve), 'dualdamp:usage', 'scenario.analysis.amplitudes holds no real numbers');
curve.analysis.amplitudes = {0.1, 0.2i};
refused(@() dualdamp_run(curve), 'dualdamp:usage', 'scenario.analysis.amplitudes{2} holds no real numbers');
bad = scenario;
bad.system.mass = 1 + 0.5i;
refused(@() dualdamp_run(bad), 'dualdamp:usage', 'scenario.system.mass holds no real numbers');
bad = scenario;
bad.system.friction = struct('law', 'coulomb', 'kinetic', {1, 1i});
refused(@() dualdamp_run(bad), 'dualdamp:usage', 'scenario.system.friction{2}.kinetic holds no real numbers');
for wrong = {1 + 1i, [1, 2]}
  refused(@() dualdamp_identify(data, 'mass', wrong{1}), 'dualdamp:usage', 'mass is one real number');
end
two = scenario;
two.system.friction = struct('law', 'coulomb', 'kinetic', {1, 1}, 'static', []);
both = dualdamp_run(two);
assert(both.result.amplitude, found.result.amplitude, -1e-9);
disp('all tests of matlab/ passed');
