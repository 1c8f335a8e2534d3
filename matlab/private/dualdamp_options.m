function options = dualdamp_options(options, pairs)
% Name-value pairs over their defaults.
  if mod(numel(pairs), 2) ~= 0
    error('dualdamp:usage', 'options come in pairs of a name and a value');
  end
  for i = 1:2:numel(pairs)
    if ~isfield(options, pairs{i})
      error('dualdamp:usage', 'there is no option ''%s''; there are: %s', pairs{i}, strjoin(fieldnames(options)', ', '));
    end
    options.(pairs{i}) = pairs{i + 1};
  end
end
