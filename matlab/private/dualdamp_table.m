function table = dualdamp_table(file)
% The columns of a CSV file of the program: numbers, or a cell array of texts.
  lines = strsplit(strtrim(fileread(file)), sprintf('\n'));
  lines = lines(cellfun(@(line) isempty(line) || line(1) ~= '#', lines));
  heads = fields(lines{1});
  rows = cellfun(@fields, lines(2:end), 'UniformOutput', false);
  cells = vertcat(rows{:});
  table = struct();
  for i = 1:numel(heads)
    name = regexprep(heads{i}, ' \[.*\]$', '');
    if isempty(cells), column = cell(0, 1); else, column = cells(:, i); end
    numbers = str2double(column);
    is_number = all(~isnan(numbers) | cellfun(@isempty, column));
    if is_number, table.(name) = numbers; else, table.(name) = column; end
  end
end

function cells = fields(line)
% Fields of one line, some of which may be quoted.
  if ~any(line == '"')
    cells = strsplit(line, ',', 'CollapseDelimiters', false);
    return;
  end
  cells = {};
  inside = false;
  field = '';
  for c = line
    if c == '"'
      inside = ~inside;
    elseif c == ',' && ~inside
      cells{end + 1} = field; %#ok<AGROW>
      field = '';
    else
      field(end + 1) = c; %#ok<AGROW>
    end
  end
  cells{end + 1} = field;
end
