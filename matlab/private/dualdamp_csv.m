function text = dualdamp_csv(data)
% Columns of equal length as the text of a CSV file; numbers read back to the same bits.
  names = fieldnames(data)';
  for name = names
    if ~isreal(data.(name{1})) || ~isnumeric(data.(name{1}))
      error('dualdamp:usage', 'the column %s holds no real numbers', name{1});
    end
  end
  columns = cellfun(@(name) double(data.(name)(:)), names, 'UniformOutput', false);
  lengths = cellfun(@numel, columns);
  if any(lengths ~= lengths(1))
    error('dualdamp:usage', 'the columns differ in length');
  end
  line = [strjoin(repmat({'%.17g'}, 1, numel(names)), ','), sprintf('\n')];
  text = [strjoin(names, ','), sprintf('\n'), sprintf(line, [columns{:}]')];
end
