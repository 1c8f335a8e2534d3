function found = dualdamp_run(scenario, varargin)
% DUALDAMP_RUN  Runs a scenario of dualdamp.
%
%   found = dualdamp_run(scenario)
%   found = dualdamp_run(scenario, 'changes', {'system.friction.kinetic=3 N'}, 'out', 'mine')
%
% scenario: the name of a scenario file, or a struct with the keys of one (docs/scenario-reference.md); a quantity is a text
% with its unit, '1 kg', or a number in SI. A key whose value is empty is left out.
%
%   'changes'   PATH=VALUE texts laid over the scenario, as the program's --set
%   'out'       directory for the files that the program writes; default: none is kept
%   'program'   the program; default: the environment variable DUALDAMP, or dualdamp
%
% found is a struct:
%   result      the result as in result.json, SI; [] where there is none
%   tables      a struct for each CSV file of a struct of columns: found.tables.curve.x; NaN where a number does not exist
%   document    all of result.json, with provenance
%   status      exit status: 0, or 1, 4, 5 for a result that lacks something
%   messages    warnings and messages of the program
%
% Errors: dualdamp:invalidScenario (every problem with its place), dualdamp:numericalFailure (no result),
% dualdamp:program (the program cannot be started). Needs MATLAB R2016b or Octave 7.
%
%   scenario.system = struct('mass', '1 kg', 'stiffness', '100 N/m', 'damping', '4 N.s/m', ...
%                            'friction', struct('law', 'coulomb', 'kinetic', '2 N'));
%   scenario.excitation = struct('type', 'base_harmonic', 'amplitude', '0.1 m', 'frequency', 'natural');
%   scenario.analysis = struct('type', 'steady_state');
%   found = dualdamp_run(scenario);
%   found.result.amplitude
  options = dualdamp_options(struct('changes', {{}}, 'out', '', 'program', ''), varargin);
  place = tempname();
  cleaner = onCleanup(@() dualdamp_remove(place));
  if isstruct(scenario)
    mkdir(place);
    file = fullfile(place, 'scenario.yaml');
    if ~isfield(scenario, 'schema'), scenario.schema = 'dualdamp/1'; end
    dualdamp_write(file, jsonencode(dualdamp_given(scenario)));
  else
    file = char(scenario);
  end
  call = {'run', file};
  if ischar(options.changes), options.changes = {options.changes}; end
  for i = 1:numel(options.changes)
    call = [call, {'--set', options.changes{i}}]; %#ok<AGROW>
  end
  found = dualdamp_call(call, options, place);
end
