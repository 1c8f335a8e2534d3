function value = dualdamp_given(value, place)
% A scenario without the keys that are empty. Complex numbers are refused, because jsonencode drops their imaginary part.
  if nargin < 2, place = 'scenario'; end
  if isnumeric(value) && ~isreal(value)
    error('dualdamp:usage', '%s holds no real numbers', place);
  elseif iscell(value)
    for i = 1:numel(value)
      value{i} = dualdamp_given(value{i}, sprintf('%s{%d}', place, i));
    end
  elseif isstruct(value) && numel(value) == 1
    for name = fieldnames(value)'
      if isempty(value.(name{1}))
        value = rmfield(value, name{1});
      else
        value.(name{1}) = dualdamp_given(value.(name{1}), [place, '.', name{1}]);
      end
    end
  elseif isstruct(value)
    value = dualdamp_given(num2cell(value), place);  % a list of maps in JSON, too
  end
end
