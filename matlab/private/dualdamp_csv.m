function text = dualdamp_csv(data)
% Columns of equal length as the text of a CSV file; numbers read back to the same bits.
  names = fieldnames(data)';
  columns = cellfun(@(name) double(data.(name)(:)), names, 'UniformOutput', false);
  lengths = cellfun(@numel, columns);
  if any(lengths ~= lengths(1))
    error('dualdamp:usage', 'the columns differ in length');
  end
  line = [strjoin(repmat({'%.17g'}, 1, numel(names)), ','), sprintf('\n')];
  text = [strjoin(names, ','), sprintf('\n'), sprintf(line, [columns{:}]')];
end
