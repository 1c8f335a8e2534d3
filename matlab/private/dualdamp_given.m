function value = dualdamp_given(value)
% A scenario without the keys that are empty.
  if isstruct(value) && numel(value) == 1
    for name = fieldnames(value)'
      if isempty(value.(name{1}))
        value = rmfield(value, name{1});
      else
        value.(name{1}) = dualdamp_given(value.(name{1}));
      end
    end
  end
end
