function found = dualdamp_identify(data, varargin)
% DUALDAMP_IDENTIFY  Identifies viscous damping and Coulomb friction from measured data.
%
%   found = dualdamp_identify('pairs.csv', 'mass', '1.042 kg', 'stiffness', '1568 N/m', 'frequency', '6.17 Hz')
%   found = dualdamp_identify(struct('Y', Y, 'x', x), 'mass', '1.042 kg', ...)
%
% data: a CSV, MATLAB or universal file; or a struct of columns in SI, named as in docs/data-files.md: Y and x; t and x; ....
%
%   'mass', 'stiffness', 'frequency'   constants of the rig with their units; each may be left out
%   'methods'   a name or a cell array of names; default: all that fit the data
%   'options'   further options of `dualdamp identify` as a cell array: {'--unit', 'x=mm', '--robust'}
%   'out'       directory for the files that the program writes; default: none is kept
%   'program'   as for dualdamp_run
%
% found is the struct that dualdamp_run returns: found.result.answer (empty where no method can be trusted; then
% found.result.answer_reason says why), found.result.estimates, found.result.verdict. Errors: as dualdamp_run.
  options = dualdamp_options(struct('mass', '', 'stiffness', '', 'frequency', '', 'methods', {{}}, 'options', {{}}, ...
                                    'out', '', 'program', ''), varargin);
  place = tempname();
  cleaner = onCleanup(@() dualdamp_remove(place));
  if isstruct(data)
    mkdir(place);
    file = fullfile(place, 'data.csv');
    dualdamp_write(file, dualdamp_csv(data));
  else
    file = char(data);
  end
  call = {'identify', file};
  for name = {'mass', 'stiffness', 'frequency'}
    value = options.(name{1});
    if ~isempty(value)
      call = [call, {['--', name{1}], dualdamp_text(name{1}, value)}]; %#ok<AGROW>
    end
  end
  if ischar(options.methods), options.methods = {options.methods}; end
  for i = 1:numel(options.methods)
    call = [call, {'--method', options.methods{i}}]; %#ok<AGROW>
  end
  found = dualdamp_call([call, options.options], options, place);
end
